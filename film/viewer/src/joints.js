// What joints and moments look like. Each part is on one of the bodies, in whose axes it is made.

import * as THREE from "three";
import { film, markersOf } from "./data.js";
import { along, colourOf, inGroundColour, mesh, METAL } from "./shapes.js";

const Z = new THREE.Vector3(0, 0, 1);
const vector = (at) => new THREE.Vector3(...at);
const dark = () => new THREE.MeshStandardMaterial({ color: 0x535c6c, ...METAL });
const light = () => new THREE.MeshStandardMaterial({ color: 0x9aa3b2, ...METAL });
const ofBody = (body) => new THREE.MeshStandardMaterial({ color: body === null ? inGroundColour : colourOf(body), ...METAL });

/** Turns what is made in the plane of x and y, about z, to an axis. */
function about(object, axis) {
  object.quaternion.setFromUnitVectors(Z, axis.clone().normalize());
  return object;
}

/** Any direction across another one. */
function across(axis) {
  const other = Math.abs(axis.x) < 0.9 ? new THREE.Vector3(1, 0, 0) : new THREE.Vector3(0, 1, 0);
  return axis.clone().cross(other).normalize();
}

/** Joints whose second point goes along a line of the first, and those where it goes in a plane. */
export const LINES = /^(Prismatic|Translational|Slide|Sleeve|Cylindrical|Screw|PointOnLine)/;
export const PLANES = /^(Planar|PointOnPlane)/;

/** The radius of a pin, over the size of the mechanism. */
export const RADIUS = 0.03;

/** The parts of a joint or force: a list of groups, each with the place of its body. `way` says how
 * far the second point goes; `null` where another joint draws it. */
export function symbol(element, size, way, small = 1) {
  const { kind, name, type, bodies } = film.elements[element];
  const said = `${name}: ${kind}`;
  const radius = RADIUS * size * small;
  const markers = (place, of) => markersOf(element, place).filter((m) => m.kind === of);
  const point = (place, called) => markers(place, "point").find((m) => !called || m.name === called);
  const axis = (place, called) => {
    const found = markers(place, "axis").find((m) => !called || m.name === called);
    return found && vector(found.at);
  };
  const parts = [];
  /** Puts what is made about the origin to a marker. */
  const put = (marker, ...objects) => {
    if (!marker) return;
    const group = new THREE.Group();
    group.position.set(...marker.at);
    group.add(...objects);
    parts.push({ place: marker.place, group });
  };
  const ball = (r = 1, material = dark()) => mesh(new THREE.SphereGeometry(r * radius, 28, 20), material, said);
  const box = (x, y, z, material = dark()) =>
    mesh(new THREE.BoxGeometry(x * radius, y * radius, z * radius), material, said);
  const round = (r, length, sides = 32, material = dark()) =>
    mesh(new THREE.CylinderGeometry(r * radius, r * radius, length * radius, sides), material, said);
  const ring = (direction, r = 0.82, thick = 0.16) =>
    about(mesh(new THREE.TorusGeometry(r * radius, thick * radius, 12, 40), dark(), said), direction);
  const hinge = (direction, length = 2.4) => [along(round(0.62, length), direction), ring(direction)];

  // Of what slides: a rail as long as the way, in radii, from the marker of the first body.
  const [low, high] = (way ?? [0, 0]).map((far) => far / radius);
  const rail = (direction, made) => {
    along(made, direction).position.copy(direction).setLength(0.5 * (low + high) * radius);
    return made;
  };
  const long = high - low + 5.4;

  if (type === "force") {
    const at = markers(0, "anchor")[0];
    if (!at || !axis(0)) return parts;
    const spring = /Spring|Bushing/.test(kind);
    put(at, spring ? spiral(axis(0), radius, said) : turning(axis(0), radius, said));
  } else if (/^(Gear|RackAndPinion)$/.test(kind)) {
    return parts;
  } else if (/^(Prismatic|Translational|Slide|Sleeve)/.test(kind) && axis(0)) {
    put(point(0), rail(axis(0), box(0.8, long, 0.8)));
    const carriage = point(1) && axis(1);
    if (carriage) put(point(1), along(box(2.1, 2.8, 2.1, ofBody(bodies[1])), axis(1)));
  } else if (/^(Cylindrical|Screw|PointOnLine)/.test(kind) && axis(0)) {
    put(point(0), rail(axis(0), round(0.42, long)));
    if (/^Screw/.test(kind)) {
      const thread = new THREE.Group();
      for (let k = 0; k < 2 * long; k++) {
        const turn = ring(axis(0), 0.42, 0.1);
        turn.position.copy(axis(0)).setLength(Math.abs(0.5 * (low + high) + 0.5 * (k - long)) * radius);
        if (0.5 * (low + high) + 0.5 * (k - long) < 0) turn.position.negate();
        thread.add(turn);
      }
      put(point(0), thread);
      put(point(1), along(round(1.3, 1.6, 6, ofBody(bodies[1])), axis(1)));
    } else if (/^Cylindrical/.test(kind)) {
      put(point(1), along(round(1.1, 2.4, 32, ofBody(bodies[1])), axis(1)));
    } else {
      put(point(1), ball(0.85));
    }
  } else if (PLANES.test(kind) && axis(0)) {
    const wide = 2 * Math.max(3, (way ?? [0, 0])[1] / radius + 2);
    const plate = box(wide, 0.16, wide, light());
    Object.assign(plate.material, { transparent: true, opacity: wide * radius < 0.8 * size ? 0.4 : 0.13, depthWrite: false });
    plate.castShadow = plate.receiveShadow = false;
    // Without a way it is drawn by another joint.
    if (way !== null) put(point(0), along(plate, axis(0)));
    put(point(1), /^Planar/.test(kind) ? along(round(1.3, 0.6), axis(1)) : ball(0.8));
  } else if (/^Universal/.test(kind) && axis(0, "axis_i") && axis(1, "axis_j")) {
    // An arm of the cross on each body.
    put(point(0), along(round(0.35, 3.4, 20), axis(0, "axis_i")), ball(0.62));
    put(point(1), along(round(0.35, 3.4, 20), axis(1, "axis_j")));
  } else if (/^ConstantVelocity/.test(kind) && axis(0, "axis_i") && axis(1, "axis_j")) {
    const shaft = (direction, side) => {
      const made = along(round(0.5, 3, 24), direction);
      made.position.copy(direction).setLength(1.5 * radius).multiplyScalar(side);
      return made;
    };
    put(point(0), ball(1.15, light()), shaft(axis(0, "axis_i"), -1));
    put(point(1), shaft(axis(1, "axis_j"), 1));
  } else if (/^(RevoluteSpherical|RevoluteRevolute)/.test(kind) && axis(0)) {
    put(point(0), ...hinge(axis(0)));
    put(point(1), ...(/^RevoluteRevolute/.test(kind) ? hinge(axis(1)) : [ball(0.9)]));
  } else if (/^Distance|Length/.test(kind)) {
    put(point(0), ball(0.7));
    put(point(1), ball(0.7));
  } else if (/^(Perpendicular|Parallel)/.test(kind)) {
    const from = point(0) ? [0] : [0, 1];
    for (const place of from) {
      const at = point(place) ?? markers(place, "anchor")[0];
      const direction = axis(place, place ? "axis_j" : undefined);
      if (at && direction) put(at, pointing(direction, radius, said));
    }
    put(point(1), ball(0.5));
  } else if (/^DisplacementDriver/.test(kind) && axis(0)) {
    const arrow = pointing(axis(0), radius, said);
    arrow.position.copy(across(axis(0))).multiplyScalar(1.6 * radius);
    put(point(0), arrow);
  } else if (/^Fixed/.test(kind)) {
    put(point(0), box(2, 2, 2));
  } else if (!point(0)) {
    // A motor: an arrow about its axis.
    const at = markers(0, "anchor")[0] ?? markers(1, "anchor")[0];
    const direction = at && axis(at.place);
    if (direction) put(at, turning(direction, radius, said));
  } else {
    put(point(0), ...(axis(0) ? hinge(axis(0)) : [ball()]));
  }
  return parts;
}

/** An arrow about an axis, right-handed. */
function turning(axis, radius, said) {
  const group = new THREE.Group();
  const [far, arc] = [1.6 * radius, 1.5 * Math.PI];
  const head = mesh(new THREE.ConeGeometry(0.36 * radius, 0.8 * radius, 20), dark(), said);
  head.position.set(far * Math.cos(arc), far * Math.sin(arc), 0);
  along(head, new THREE.Vector3(-Math.sin(arc), Math.cos(arc), 0));
  const made = new THREE.Group();
  made.add(mesh(new THREE.TorusGeometry(far, 0.13 * radius, 10, 48, arc), dark(), said), head);
  // Beside the hinge that it turns.
  made.position.z = 1.7 * radius;
  group.add(made);
  return about(group, axis);
}

/** An arrow along a direction. */
function pointing(direction, radius, said) {
  const group = new THREE.Group();
  const shaft = mesh(new THREE.CylinderGeometry(0.16 * radius, 0.16 * radius, 3 * radius, 12), dark(), said);
  shaft.position.y = 1.5 * radius;
  const head = mesh(new THREE.ConeGeometry(0.42 * radius, 0.95 * radius, 20), dark(), said);
  head.position.y = 3.4 * radius;
  group.add(shaft, head);
  return along(group, direction);
}

/** A torsional spring: a flat spiral about an axis. */
function spiral(axis, radius, said) {
  class Spiral extends THREE.Curve {
    getPoint(t, target = new THREE.Vector3()) {
      const far = radius * (0.9 + 1.3 * t);
      return target.set(far * Math.cos(6 * Math.PI * t), far * Math.sin(6 * Math.PI * t), 0);
    }
  }
  return about(mesh(new THREE.TubeGeometry(new Spiral(), 160, 0.14 * radius, 8), light(), said), axis);
}

/** Where a tooth is half as wide as this, in teeth, over the pitch circle: root, flank, tip. */
const TOOTH = [[-0.37, -1.2], [-0.31, -1], [-0.13, 1], [0.13, 1], [0.31, -1], [0.37, -1.2]];

/** A toothed wheel, its teeth on the pitch circle: a rim with a thin disc in it, or a ring. */
export function wheel({ elements, body, axis, tooth, centre, radius, teeth, isRing }, size) {
  const said = elements.map((k) => `${film.elements[k].name}: ${film.elements[k].kind}`).join(", ");
  const high = (radius / teeth) * (isRing ? -2 : 2);
  const corners = [];
  for (let k = 0; k < teeth; k++)
    for (const [side, up] of TOOTH) {
      const angle = (2 * Math.PI * (k + side)) / teeth;
      const far = radius + 0.9 * up * high;
      corners.push(new THREE.Vector2(far * Math.cos(angle), far * Math.sin(angle)));
    }
  const edge = radius + (isRing ? 4.5 * Math.abs(high) : -3 * high);
  const circle = new THREE.Path().absarc(0, 0, Math.max(edge, 0.1 * radius), 0, 2 * Math.PI);
  const outer = isRing ? new THREE.Shape(circle.getPoints(96)) : new THREE.Shape(corners);
  outer.holes.push(isRing ? new THREE.Path(corners) : circle);
  const thick = Math.min(0.03 * size, 0.35 * radius);
  const material = ofBody(body);
  const made = new THREE.Group();
  const rim = mesh(new THREE.ExtrudeGeometry(outer, { depth: thick, bevelEnabled: false, curveSegments: 72 }), material, said);
  rim.position.z = -0.5 * thick;
  made.add(rim);
  if (!isRing) {
    const disc = material.clone();
    Object.assign(disc, { transparent: true, opacity: 0.45, depthWrite: false });
    const web = mesh(new THREE.CylinderGeometry(edge, edge, 0.3 * thick, 64).rotateX(Math.PI / 2), disc, said);
    web.castShadow = false;
    made.add(web);
  }
  made.position.set(...centre);
  const [x, z] = [vector(tooth), vector(axis)];
  made.quaternion.setFromRotationMatrix(new THREE.Matrix4().makeBasis(x, z.clone().cross(x), z));
  return made;
}

/** A rack, its teeth on the pitch line. */
export function rack({ element, body, at, along: way, tips, pitch, teeth }, size) {
  const { name, kind } = film.elements[element];
  const high = pitch / Math.PI;
  const [first, last] = teeth;
  const corners = [];
  for (let k = first; k <= last; k++)
    for (const [side, up] of TOOTH) corners.push(new THREE.Vector2((k + side) * pitch, 0.9 * up * high));
  corners.push(new THREE.Vector2((last + 0.5) * pitch, -3 * high), new THREE.Vector2((first - 0.5) * pitch, -3 * high));
  const thick = Math.min(0.03 * size, 4 * pitch);
  const material = ofBody(body);
  const shape = new THREE.ExtrudeGeometry(new THREE.Shape(corners), { depth: thick, bevelEnabled: false });
  const made = mesh(shape.translate(0, 0, -0.5 * thick), material, `${name}: ${kind}`);
  made.position.set(...at);
  const [x, y] = [vector(way), vector(tips)];
  made.quaternion.setFromRotationMatrix(new THREE.Matrix4().makeBasis(x, y, x.clone().cross(y)));
  return made;
}
