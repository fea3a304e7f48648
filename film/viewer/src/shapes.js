// What bodies, springs and arrows look like. Lengths are fractions of the size of the mechanism.

import * as THREE from "three";
import { ConvexGeometry } from "three/addons/geometries/ConvexGeometry.js";
import { film, points, spanning } from "./data.js";
import { surface } from "./surfaces.js";

const UP = new THREE.Vector3(0, 1, 0);
const vector = (at) => new THREE.Vector3(...at);

/** Colours of bodies: apart in hue and in lightness, on light and on dark ground. */
const COLOURS = [0x4c8eda, 0xe8853d, 0x4fae6a, 0xc85f8e, 0x8e77d6, 0xc9a227, 0x3aa6a6, 0xa8734b];
export const colourOf = (index) => COLOURS[index % COLOURS.length];

export const METAL = { metalness: 0.35, roughness: 0.42 };
/** Of what stands still. */
export const inGroundColour = 0x8a93a3;

export function mesh(geometry, material, name) {
  const made = new THREE.Mesh(geometry, material);
  made.castShadow = true;
  made.receiveShadow = true;
  made.userData.name = name;
  return made;
}

/** Turns something that is made along y into a direction. */
export function along(object, direction) {
  object.quaternion.setFromUnitVectors(UP, direction.clone().normalize());
  return object;
}

/** Points on a ball. */
function ball(centre, radius) {
  const golden = Math.PI * (3 - Math.sqrt(5));
  return Array.from({ length: 64 }, (_, k) => {
    const y = 1 - (2 * (k + 0.5)) / 64;
    const around = Math.sqrt(1 - y * y);
    const turned = golden * k;
    const unit = new THREE.Vector3(Math.cos(turned) * around, y, Math.sin(turned) * around);
    return unit.multiplyScalar(radius).add(centre);
  });
}

/** Places that differ by more than a hair. */
function distinct(places, size) {
  const kept = [];
  for (const place of places)
    if (kept.every((known) => known.distanceTo(place) > 1e-3 * size)) kept.push(place);
  return kept;
}

/** A body: bars from point to point of its joints and to its centre of mass, the shortest that
 * join all, and a plate where three points or more span one. Of a body that nothing names a point
 * of, a cube. */
export function body(index, size, small = 1) {
  const { name, particle } = film.bodies[index];
  const group = new THREE.Group();
  const material = new THREE.MeshStandardMaterial({ color: colourOf(index), ...METAL });
  const radius = 0.018 * size * small;
  const solids = film.shapes.filter((solid) => solid.body === index);
  const meshes = film.meshes.filter((mesh) => mesh.body === index);
  if (solids.length || meshes.length) {
    for (const solid of solids) group.add(drawn(solid, material, name));
    for (const mesh of meshes) group.add(surface(mesh, material, name));
    return group;
  }
  const named = distinct(points(index).map((m) => vector(m.at)), size);
  if (particle || named.length === 0) {
    const shape = particle
      ? new THREE.SphereGeometry(2.2 * radius, 32, 20)
      : new THREE.BoxGeometry(5 * radius, 5 * radius, 5 * radius);
    group.add(mesh(shape, material, name));
    return group;
  }
  const all = distinct([...named, new THREE.Vector3()], size);
  for (const [from, to] of shortest(all)) group.add(capsule(from, to, radius, material, name));
  // Small enough for its joint to be seen.
  if (all.length === 1) group.add(mesh(new THREE.SphereGeometry(1.4 * radius, 32, 20), material, name));
  // The centre of mass of a leaf on two hinges is far from both.
  const spanned = distinct(spanning(index).map((m) => vector(m.at)), size);
  const whole = distinct([...spanned, new THREE.Vector3()], size);
  const corners = inLine(whole, 0.25) ? spanned : whole;
  if (corners.length > 2 && !inLine(corners)) {
    const hull = new ConvexGeometry(corners.flatMap((corner) => ball(corner, 0.55 * radius)));
    const plate = material.clone();
    Object.assign(plate, { transparent: true, opacity: 0.42, depthWrite: false });
    group.add(mesh(hull, plate, name));
  }
  return group;
}

/** A shape that the description names. What is made along y is laid along its x axis. */
function drawn({ kind, sizes, centre, axes }, material, name) {
  const [long, wide, narrow] = sizes;
  const ROUND = 48;
  const geometry = {
    cylinder: () => new THREE.CylinderGeometry(wide, wide, long, ROUND),
    tube: () => tube(long, wide, narrow, ROUND),
    // Its centre of mass is a quarter of the way from the base.
    cone: () => new THREE.ConeGeometry(wide, long, ROUND).translate(0, 0.25 * long, 0),
    block: () => new THREE.BoxGeometry(long, wide, narrow),
    ball: () => new THREE.SphereGeometry(long, ROUND, 32),
  }[kind]();
  if (["cylinder", "tube", "cone"].includes(kind)) geometry.rotateZ(-Math.PI / 2);
  const made = mesh(geometry, material, name);
  made.position.set(...centre);
  const [w, x, y, z] = axes;
  made.quaternion.set(x, y, z, w);
  return made;
}

function tube(long, outer, inner, round) {
  const [a, b] = [0.5 * long, -0.5 * long];
  const corners = [[inner, b], [outer, b], [outer, a], [inner, a], [inner, b]];
  // Every corner twice, so that edges are sharp.
  const wall = corners.flatMap((corner) => [corner, corner]).slice(1, -1);
  return new THREE.LatheGeometry(wall.map(([x, y]) => new THREE.Vector2(x, y)), round);
}

/** The shortest lines that join all places (Prim). */
function shortest(places) {
  const lines = [];
  const joined = [places[0]];
  const rest = places.slice(1);
  while (rest.length) {
    let best = [Infinity];
    for (const from of joined)
      rest.forEach((to, k) => {
        const far = from.distanceTo(to);
        if (far < best[0]) best = [far, from, k];
      });
    const [to] = rest.splice(best[2], 1);
    lines.push([best[1], to]);
    joined.push(to);
  }
  return lines;
}

function inLine(places, near = 0.02) {
  if (places.length < 3) return true;
  const line = new THREE.Line3(places[0], places[1]);
  const nearest = new THREE.Vector3();
  return places.every((place) => {
    line.closestPointToPoint(place, false, nearest);
    return nearest.distanceTo(place) < near * line.distance();
  });
}

function capsule(from, to, radius, material, name) {
  const way = to.clone().sub(from);
  const made = mesh(new THREE.CapsuleGeometry(radius, way.length(), 8, 24), material, name);
  along(made, way);
  made.position.copy(from).addScaledVector(way, 0.5);
  return made;
}

/** A rod between two places. */
export function rod(from, to, radius, material, name) {
  const way = to.clone().sub(from);
  const made = mesh(new THREE.CylinderGeometry(radius, radius, way.length(), 20), material, name);
  along(made, way.lengthSq() ? way : UP);
  made.position.copy(from).addScaledVector(way, 0.5);
  return made;
}

/** The axes of a body, at its centre of mass: x red, y green, z blue, seen through what they are in. */
export function frame(length, name) {
  const group = new THREE.Group();
  const colours = [0xe0453a, 0x2fa84f, 0x3b6fe0];
  colours.forEach((color, k) => {
    const material = new THREE.MeshBasicMaterial({ color, depthTest: false, transparent: true });
    const shaft = mesh(new THREE.CylinderGeometry(0.035 * length, 0.035 * length, 0.8 * length, 10), material, `${"xyz"[k]} axis of ${name}`);
    shaft.position.y = 0.4 * length;
    const head = mesh(new THREE.ConeGeometry(0.09 * length, 0.2 * length, 16), material, shaft.userData.name);
    head.position.y = 0.9 * length;
    const arrow = new THREE.Group();
    for (const part of [shaft, head]) {
      part.renderOrder = 5;
      part.castShadow = part.receiveShadow = false;
      arrow.add(part);
    }
    group.add(along(arrow, new THREE.Vector3().setComponent(k, 1)));
  });
  return group;
}

/** The centre of mass: a ball in quarters, as in drawings. */
export function centreOfMass(size, name) {
  const group = new THREE.Group();
  const radius = 0.014 * size;
  for (let octant = 0; octant < 8; octant++) {
    const light = (octant ^ (octant >> 1) ^ (octant >> 2)) & 1;
    const material = new THREE.MeshBasicMaterial({
      color: light ? 0xf4f4f4 : 0x1c1f26, depthTest: false, transparent: true });
    const turn = ((octant & 3) * Math.PI) / 2;
    const below = octant > 3 ? Math.PI / 2 : 0;
    const shape = new THREE.SphereGeometry(radius, 8, 6, turn, Math.PI / 2, below, Math.PI / 2);
    const part = mesh(shape, material, `centre of mass of ${name}`);
    part.renderOrder = 5;
    part.castShadow = false;
    group.add(part);
  }
  return group;
}

/** A named point: a diamond that faces the reader, in the colour of its body, seen through what it
 * is in. */
export function mark(at, size, body, said) {
  const paper = document.createElement("canvas");
  paper.width = paper.height = 64;
  const pen = paper.getContext("2d");
  const fill = body === null ? inGroundColour : colourOf(body);
  for (const [far, colour] of [[31, "#1c1f26"], [25, "#fff"], [16, `#${fill.toString(16).padStart(6, "0")}`]]) {
    pen.fillStyle = colour;
    pen.beginPath();
    for (const [x, y] of [[1, 0], [0, 1], [-1, 0], [0, -1]]) pen.lineTo(32 + far * x, 32 + far * y);
    pen.fill();
  }
  const map = new THREE.CanvasTexture(paper);
  map.colorSpace = THREE.SRGBColorSpace;
  const made = new THREE.Sprite(new THREE.SpriteMaterial({ map, depthTest: false, transparent: true }));
  made.scale.setScalar(0.042 * size);
  made.renderOrder = 6;
  made.userData.name = said;
  made.position.set(...at);
  return made;
}

/** What stands on the ground at a point: a foot that points down. */
export function foot(at, down, size) {
  const radius = 0.05 * size;
  const material = new THREE.MeshStandardMaterial({ color: inGroundColour, metalness: 0.1, roughness: 0.8 });
  const cone = mesh(new THREE.ConeGeometry(radius, 1.5 * radius, 4, 1), material, "ground");
  along(cone, down.clone().negate());
  cone.position.set(...at).addScaledVector(down, 0.75 * radius);
  return cone;
}

/** A coil between two places that move: made once along y with length 1, then stretched. */
export function coil(size, turns = 9) {
  class Helix extends THREE.Curve {
    getPoint(t, target = new THREE.Vector3()) {
      const wound = Math.min(1, Math.max(0, (t - 0.1) / 0.8));
      const off = 0.028 * size * Math.min(1, Math.min(t, 1 - t) / 0.1);
      const angle = 2 * Math.PI * turns * wound;
      return target.set(off * Math.cos(angle), t, off * Math.sin(angle));
    }
  }
  const material = new THREE.MeshStandardMaterial({ color: 0x9aa3b2, metalness: 0.6, roughness: 0.35 });
  return (from, to, previous) => {
    // Only the centre line is stretched: the wire keeps its thickness.
    const length = from.distanceTo(to);
    const helix = new Helix();
    const line = { getPoint: (t, v) => helix.getPoint(t, v).multiply({ x: 1, y: length, z: 1 }) };
    const curve = Object.assign(new THREE.Curve(), line);
    const geometry = new THREE.TubeGeometry(curve, 24 * turns, 0.0055 * size, 7);
    const made = previous ?? mesh(geometry, material);
    if (previous) {
      previous.geometry.dispose();
      previous.geometry = geometry;
    }
    if (length > 0) along(made, to.clone().sub(from));
    made.position.copy(from);
    return made;
  };
}

/** An arrow that is set anew in every frame. */
export function arrow(colour, size, small, said) {
  const group = new THREE.Group();
  const material = new THREE.MeshBasicMaterial({ color: colour, depthTest: false, transparent: true, opacity: 0.9 });
  const shaft = new THREE.Mesh(new THREE.CylinderGeometry(1, 1, 1, 12), material);
  const head = new THREE.Mesh(new THREE.ConeGeometry(1, 1, 20), material);
  group.add(shaft, head);
  group.renderOrder = 4;
  for (const part of group.children) {
    part.renderOrder = 4;
    part.userData.name = said;
  }
  group.setArrow = (at, way) => {
    const length = way.length();
    group.visible = Number.isFinite(length) && length > 0.004 * size;
    if (!group.visible) return;
    const tip = Math.min(0.045 * size * small, 0.4 * length);
    const thick = 0.006 * size * small;
    shaft.scale.set(thick, length - tip, thick);
    shaft.position.y = 0.5 * (length - tip);
    head.scale.set(0.36 * tip, tip, 0.36 * tip);
    head.position.y = length - 0.5 * tip;
    along(group, way);
    group.position.copy(at);
  };
  return group;
}
