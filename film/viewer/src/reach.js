// How far the mechanism reaches: what views fit, what pins are measured by, and whether it is plane.

import * as THREE from "three";
import { film, markersOf, points, POSE } from "./data.js";

const vector = (at) => new THREE.Vector3(...at);
const isPoint = (marker) => marker.kind === "point";

/** Position and orientation of a body in a frame. */
export function poseIn(frame, body, turn = new THREE.Quaternion()) {
  const first = (frame * film.bodies.length + body) * POSE;
  const [x, y, z, e0, e1, e2, e3] = film.poses.subarray(first, first + POSE);
  return [new THREE.Vector3(x, y, z), turn.set(e1, e2, e3, e0).normalize()];
}

/** A point or direction of a marker in global axes, in a frame. */
export function global(marker, frame) {
  const at = vector(marker.at);
  if (marker.body === null) return at;
  const [place, turn] = poseIn(frame, marker.body);
  at.applyQuaternion(turn);
  return marker.kind === "axis" ? at : at.add(place);
}

/** Eight corners of a box about a centre. */
const box = (half) => Array.from({ length: 8 }, (_, k) => vector(half.map((far, axis) => (k & (1 << axis) ? far : -far))));

/** What a body reaches to, in its axes: its points, shapes, meshes and wheels. The ground's ends of forces may be
 * far away, and have no mass: they are left out. */
function reach(body) {
  const isFar = (marker) => body === null && film.elements[marker.element]?.type === "force";
  const places = points(body).filter((marker) => !isFar(marker)).map((marker) => vector(marker.at));
  for (const { sizes, kind, centre, axes } of film.shapes.filter((shape) => shape.body === body)) {
    const [long, wide, narrow] = sizes;
    const half = { block: [long / 2, wide / 2, narrow / 2], ball: [long, long, long] }[kind] ?? [long / 2, wide, wide];
    const [w, x, y, z] = axes;
    for (const corner of box(half))
      places.push(corner.applyQuaternion(new THREE.Quaternion(x, y, z, w)).add(vector(centre)));
  }
  for (const { low, high } of film.meshes.filter((mesh) => mesh.body === body)) {
    const centre = vector(low).add(vector(high)).multiplyScalar(0.5);
    for (const corner of box(low.map((least, k) => 0.5 * (high[k] - least)))) places.push(corner.add(centre));
  }
  for (const { centre, axis, tooth, radius } of film.wheels.filter((wheel) => wheel.body === body))
    for (let k = 0; k < 12; k++)
      places.push(vector(tooth).applyAxisAngle(vector(axis), (k * Math.PI) / 6).multiplyScalar(radius).add(vector(centre)));
  return places;
}

/** Frames to look at: at most some 120. */
function* frames() {
  const stride = Math.max(1, Math.floor(film.times.length / 120));
  for (let frame = 0; frame < film.times.length; frame += stride) yield frame;
}

/** Where all that is, in all frames. */
export function cloud() {
  const places = reach(null);
  const own = film.bodies.map((_, body) => reach(body));
  const turn = new THREE.Quaternion();
  for (const frame of frames()) {
    film.bodies.forEach((_, body) => {
      const [at, p] = poseIn(frame, body, turn);
      places.push(at.clone());
      for (const place of own[body]) places.push(place.clone().applyQuaternion(p).add(at));
    });
  }
  // Ends of forces that are near: a spring is seen whole.
  const near = new THREE.Box3().setFromPoints(places);
  near.expandByScalar(0.3 * near.getSize(new THREE.Vector3()).length());
  for (const marker of film.markers.filter((m) => m.body === null && isPoint(m)))
    if (near.containsPoint(vector(marker.at))) places.push(vector(marker.at));
  return places.length ? places : [new THREE.Vector3()];
}

/** The size of the mechanism as it stands at the start: what pins and rods are measured by. */
export function sizeAtStart() {
  const all = new THREE.Box3();
  for (const place of reach(null)) all.expandByPoint(place);
  film.bodies.forEach((_, body) => {
    const [at, turn] = poseIn(0, body);
    all.expandByPoint(at);
    for (const place of reach(body)) all.expandByPoint(place.applyQuaternion(turn).add(at));
  });
  return all.isEmpty() ? 0 : all.getSize(new THREE.Vector3()).length();
}

/** A pin is at most this part of the way to the next joint. */
const PIN = 0.2;

/** By how much the symbols of each element are smaller than `radius`, so that those beside them are seen. */
export function nearness(size, radius) {
  const ends = film.markers.filter(isPoint).map((marker) => ({ element: marker.element, at: global(marker, 0) }));
  return film.elements.map((_, index) => {
    let nearest = Infinity;
    for (const { at } of ends.filter((end) => end.element === index))
      for (const other of ends) {
        const far = other.element === index ? Infinity : at.distanceTo(other.at);
        if (far > 1e-3 * size) nearest = Math.min(nearest, far);
      }
    return Math.min(1, Math.max(0.15, (PIN * nearest) / radius));
  });
}

/** Joints that slide: across the normal, where a mechanism is plane. */
const SLIDES = /^(Prismatic|PointOnLine|DisplacementDriver|Translational|Slide|Sleeve)/;

/** The normal of a plane mechanism, else `null`: axes of joints are along it or slide across it, and nothing moves
 * along it. */
export function normal(size) {
  const joints = film.markers.filter((m) => m.kind === "axis" && film.elements[m.element].type === "joint");
  const axes = joints.map((marker) => ({ slides: SLIDES.test(film.elements[marker.element].kind), axis: global(marker, 0).normalize() }));
  const turning = axes.find(({ slides }) => !slides);
  const candidates = turning ? [turning.axis] : [[0, 0, 1], [0, 1, 0], [1, 0, 0]].map(vector);
  return candidates.find((way) => {
    const fits = ({ slides, axis }) => {
      const along = Math.abs(axis.dot(way));
      return along > 0.999 || (slides && along < 0.001);
    };
    return axes.every(fits) && staysAcross(way, size, !turning);
  }) ?? null;
}

/** Whether bodies move and turn in planes across a direction; `thin`: whether all is in one plane. */
function staysAcross(way, size, thin) {
  const near = (a, b) => Math.abs(a - b) < 2e-3 * size;
  const first = film.bodies.map((_, body) => poseIn(0, body));
  for (const frame of frames())
    for (let body = 0; body < film.bodies.length; body++) {
      const [at, turn] = poseIn(frame, body);
      if (!near(at.dot(way), first[body][0].dot(way))) return false;
      if (film.bodies[body].particle) continue;
      const own = way.clone().applyQuaternion(first[body][1].clone().invert());
      if (own.applyQuaternion(turn).dot(way) < 0.999) return false;
    }
  if (!thin) return true;
  const far = film.markers.filter(isPoint).map((marker) => global(marker, 0).dot(way));
  first.forEach(([at]) => far.push(at.dot(way)));
  return near(Math.min(...far), Math.max(...far));
}

/** How far the second body's point goes from the first body's: along its axis, least and most; from it, where it
 * moves in a plane. */
export function wayOf(index, isPlane) {
  const markers = (place, kind) => markersOf(index, place).find((m) => m.kind === kind);
  const [from, axis, to] = [markers(0, "point"), markers(0, "axis"), markers(1, "point")];
  if (!from || !axis || !to) return undefined;
  let [low, high] = [0, 0];
  for (let frame = 0; frame < film.times.length; frame++) {
    const off = global(to, frame).sub(global(from, frame));
    const far = isPlane ? off.length() : off.dot(global(axis, frame));
    [low, high] = [Math.min(low, far), Math.max(high, far)];
  }
  return [low, high];
}
