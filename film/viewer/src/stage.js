// The mechanism on a stage: bodies, joints, forces and traces, moved to a time.

import * as THREE from "three";
import { Line2 } from "three/addons/lines/Line2.js";
import { LineGeometry } from "three/addons/lines/LineGeometry.js";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { film, frameAt, LOAD, markersOf, POSE } from "./data.js";
import { LINES, PLANES, rack, RADIUS, symbol, wheel } from "./joints.js";
import { cloud, nearness, normal, poseIn, sizeAtStart, wayOf } from "./reach.js";
import * as shapes from "./shapes.js";
import { surface } from "./surfaces.js";

const vector = (at) => new THREE.Vector3(...at);

/** Joints that are drawn as a line between two points. */
const LINKS = /^Distance|Length|^RevoluteSpherical|^RevoluteRevolute|^(Perpendicular|Parallel)2/;

/** Of planes of one body that are one plane, leaves the first, as wide as all. */
function joinPlanes(ways, size) {
  const kept = [];
  film.elements.forEach((element, index) => {
    if (!PLANES.test(element.kind) || !ways[index]) return;
    const [at, normal] = ["point", "axis"].map((kind) => vector(markersOf(index, 0).find((m) => m.kind === kind).at));
    const far = (other) => at.clone().sub(other.at);
    const same = kept.find((other) => other.body === element.bodies[0]
      && normal.clone().cross(other.normal).length() < 1e-3 * normal.length() * other.normal.length()
      && Math.abs(far(other).dot(normal)) < 1e-3 * size * normal.length());
    if (!same) return void kept.push({ index, body: element.bodies[0], at, normal });
    const widest = ways[same.index];
    widest[1] = Math.max(widest[1], far(same).length() + ways[index][1]);
    ways[index] = null;
  });
}

/** What is on the stage. `former` is a stage of the same mechanism whose sizes are kept. */
export function stage(scene, former = null) {
  const places = cloud();
  const box = new THREE.Box3().setFromPoints(places);
  const size = former?.size ?? (sizeAtStart() || box.getSize(new THREE.Vector3()).length() || 1);
  const down = vector(film.gravity);
  const isFlat = box.max.z - box.min.z < 0.02 * size;
  const free = isFlat ? new THREE.Vector3(0, 1, 0) : new THREE.Vector3(0, 0, 1);
  const up = down.lengthSq() > 0 ? down.clone().negate().normalize() : free;
  const ground = new THREE.Group();
  const small = nearness(size, RADIUS * size);
  /** The smallest of what is on a body. */
  const smallOn = (body) => Math.min(1, ...small.filter((_, k) => film.elements[k].bodies.includes(body)));
  const bodies = film.bodies.map((_, index) => shapes.body(index, size, smallOn(index)));
  const layers = {
    bodies: new THREE.Group(), joints: new THREE.Group(), forces: new THREE.Group(),
    reactions: new THREE.Group(), traces: new THREE.Group(), centres: new THREE.Group(),
    points: new THREE.Group(), frames: new THREE.Group(), ghost: new THREE.Group(),
  };
  scene.add(ground, ...Object.values(layers));
  bodies.forEach((body, index) => {
    body.userData.part = { kind: "body", index };
    layers.bodies.add(body);
  });
  const ghosts = film.ghost ? film.bodies.map((_, index) => ghost(shapes.body(index, size, smallOn(index)), index)) : [];
  ghosts.forEach((body) => layers.ghost.add(body));
  const root = film.meshes.filter((mesh) => mesh.body === null);
  const stone = new THREE.MeshStandardMaterial({ color: shapes.inGroundColour, ...shapes.METAL, side: THREE.DoubleSide });
  for (const mesh of root) ground.add(surface(mesh, stone, "ground"));

  // Groups that move with a body but are shown and hidden with a layer of their own.
  const riders = [];
  const ride = (layer, body, object) => {
    if (body === null) {
      ground.add(object);
    } else {
      layer.add(object);
      riders.push([body, object]);
    }
  };
  film.bodies.forEach((body, index) => {
    const little = Math.max(0.5, smallOn(index));
    if (!body.particle) {
      ride(layers.centres, index, shapes.centreOfMass(size * little, body.name));
      ride(layers.frames, index, shapes.frame(0.14 * size * little, body.name));
    }
  });
  for (const { name, body, at } of film.points) {
    const holder = new THREE.Group();
    holder.add(shapes.mark(at, size * (body === null ? 1 : Math.max(0.45, smallOn(body))), body, `${name}: point on ${body === null ? "ground" : film.bodies[body].name}`));
    if (body === null) layers.points.add(holder);
    else ride(layers.points, body, holder);
  }
  const ways = former?.ways ?? film.elements.map(({ kind }, index) => {
    const isPlane = PLANES.test(kind);
    return isPlane || LINES.test(kind) ? wayOf(index, isPlane) : undefined;
  });
  if (!former) joinPlanes(ways, size);
  const elements = film.elements.map((element, index) => {
    const parts = [];
    const layer = element.type === "joint" ? layers.joints : layers.forces;
    const add = (body, group) => {
      // A holder that moves with the body, so that the group keeps its place on it.
      const holder = new THREE.Group();
      holder.add(group);
      holder.userData.part = { kind: "element", index };
      parts.push(group);
      if (body === null) layer.add(holder);
      else ride(layer, body, holder);
    };
    for (const { place, group } of symbol(index, size, ways[index], small[index])) add(element.bodies[place], group);
    for (const made of film.wheels.filter((wheel) => wheel.elements[0] === index)) add(made.body, wheel(made, size));
    for (const made of film.racks.filter((rack) => rack.element === index)) add(made.body, rack(made, size));
    element.bodies.forEach((body, place) => {
      if (body !== null || PLANES.test(element.kind) || root.length) return;
      for (const marker of markersOf(index, place).filter((m) => m.kind === "point"))
        ground.add(shapes.foot(marker.at, up.clone().negate(), size * small[index]));
    });
    return parts;
  });

  // Springs, dampers and cables: a coil or line between their two points.
  const lines = [];
  film.elements.forEach((element, index) => {
    const ends = element.bodies.flatMap((body, place) =>
      markersOf(index, place).filter((m) => m.kind === "point"));
    const isLine = element.type === "force" || LINKS.test(element.kind);
    const pair = linePair(element, ends);
    if (!isLine || !pair) return;
    const isCoil = element.type === "force" && /Spring|Bushing/.test(element.kind);
    lines.push({ index, pair, draw: isCoil ? shapes.coil(size * Math.max(0.4, small[index])) : null, object: null });
  });

  // Arrows: what was recorded of joints, on a scale that fits the largest.
  let largest = 0;
  for (let k = 3; k < film.loads.length; k += LOAD) {
    const force = Math.hypot(film.loads[k], film.loads[k + 1], film.loads[k + 2]);
    if (Number.isFinite(force)) largest = Math.max(largest, force);
  }
  const perMetre = largest > 0 ? rounded(largest / (0.35 * size)) : 1;
  if (film.showArrows) {
    const tip = new THREE.Vector3();
    for (let k = 0; k < film.loads.length; k += LOAD * Math.max(1, film.arrows.length)) {
      for (let arrow = 0; arrow < film.arrows.length; arrow++) {
        const [x, y, z, fx, fy, fz] = film.loads.subarray(k + arrow * LOAD);
        tip.set(x + fx / perMetre, y + fy / perMetre, z + fz / perMetre);
        if (Number.isFinite(tip.lengthSq())) places.push(tip.clone());
      }
    }
  }
  const arrows = film.arrows.map(({ joint }) => {
    const arrow = shapes.arrow(0xd6455d, size, Math.max(0.4, small[joint]), `reaction of ${film.elements[joint].name}`);
    arrow.userData.part = { kind: "element", index: joint };
    layers.reactions.add(arrow);
    return arrow;
  });

  // Traces: the whole way faint, what was passed strong.
  const traces = film.traces.map((trace) => {
    const colour = shapes.colourOf(trace.body);
    const [all, passed] = [[1.5, 0.3], [2.5, 1]].map(([width, opacity]) => line(colour, width, opacity));
    const dot = new THREE.Mesh(new THREE.SphereGeometry(0.012 * size, 16, 12), new THREE.MeshBasicMaterial({ color: colour }));
    dot.userData.name = trace.name;
    layers.traces.add(all, passed, dot);
    return { trace, way: null, all, passed, dot };
  });
  /** Draws traces through the frames that there are; `known` of them are as they were, `gone` before them are not. */
  function retrace(known = 0, gone = 0) {
    const count = film.times.length;
    const at = new THREE.Vector3();
    for (const each of traces) {
      const before = each.way;
      each.way = new Float32Array(3 * count);
      if (known) each.way.set(before.subarray(3 * gone, 3 * (gone + known)));
      for (let frame = known; frame < count; frame++) {
        const [origin, turn] = poseIn(frame, each.trace.body);
        at.set(...each.trace.at).applyQuaternion(turn).add(origin).toArray(each.way, 3 * frame);
      }
      for (const drawn of [each.all, each.passed]) {
        drawn.visible = count > 1;
        drawn.geometry.dispose();
        if (count > 1) drawn.geometry = new LineGeometry().setPositions(each.way);
      }
    }
  }
  retrace();

  const [a, b] = [new THREE.Quaternion(), new THREE.Quaternion()];
  function place(object, body, { low, next, part }, poses = film.poses) {
    const count = film.bodies.length;
    const p = poses.subarray((low * count + body) * POSE);
    const q = poses.subarray((next * count + body) * POSE);
    object.position.set(...[0, 1, 2].map((k) => p[k] + part * (q[k] - p[k])));
    a.set(p[4], p[5], p[6], p[3]).normalize();
    b.set(q[4], q[5], q[6], q[3]).normalize();
    object.quaternion.copy(a).slerp(b, part);
  }
  const placed = (marker) => {
    const at = vector(marker.at);
    if (marker.body === null) return at;
    const body = bodies[marker.body];
    return at.applyQuaternion(body.quaternion).add(body.position);
  };

  function show(time) {
    const frame = frameAt(time);
    bodies.forEach((body, index) => place(body, index, frame));
    if (film.ghost) {
      const other = frameAt(time, film.ghost.times);
      ghosts.forEach((body, index) => place(body, index, other, film.ghost.poses));
    }
    for (const [body, object] of riders) {
      object.position.copy(bodies[body].position);
      object.quaternion.copy(bodies[body].quaternion);
    }
    for (const line of lines) {
      const [from, to] = line.pair.map(placed);
      const said = `${film.elements[line.index].name}: ${film.elements[line.index].kind}`;
      if (line.draw) {
        const made = line.draw(from, to, line.object);
        if (!line.object) layers.forces.add(made);
        line.object = made;
      } else {
        if (line.object) {
          layers.forces.remove(line.object);
          line.object.geometry.dispose();
        }
        line.material ??= new THREE.MeshStandardMaterial({ color: 0x9aa3b2, metalness: 0.5, roughness: 0.4 });
        line.object = shapes.rod(from, to, 0.006 * size, line.material, said);
        layers.forces.add(line.object);
      }
      line.object.userData.name = said;
      line.object.userData.part = { kind: "element", index: line.index };
      line.object.visible = !line.hidden;
    }
    const nearest = frame.part < 0.5 ? frame.low : frame.next;
    arrows.forEach((arrow, k) => {
      const [x, y, z, fx, fy, fz] = film.loads.subarray((nearest * arrows.length + k) * LOAD);
      arrow.setArrow(new THREE.Vector3(x, y, z), new THREE.Vector3(fx, fy, fz).divideScalar(perMetre));
    });
    for (const { way, passed, dot } of traces) {
      passed.geometry.instanceCount = frame.low;
      const [from, to] = [3 * frame.low, 3 * frame.next];
      dot.position.set(...[0, 1, 2].map((k) => way[from + k] + frame.part * (way[to + k] - way[from + k])));
    }
  }

  const hide = (kind, index, hidden) => {
    if (kind === "body") bodies[index].visible = !hidden;
    else {
      elements[index].forEach((part) => (part.visible = !hidden));
      lines.filter((line) => line.index === index).forEach((line) => (line.hidden = hidden));
    }
  };
  /** Lights a body, joint or force up, and no other. */
  const light = (part) => {
    const all = [...bodies, ...elements.flat()];
    const lit = part === null ? [] : part.kind === "body" ? [bodies[part.index]] : elements[part.index];
    for (const object of all)
      object.traverse(({ material }) => material?.emissive?.setHex(lit.includes(object) ? 0x553311 : 0));
  };
  /** Takes everything away. */
  function remove() {
    for (const group of [ground, ...Object.values(layers)]) {
      scene.remove(group);
      group.traverse((object) => object.geometry?.dispose());
    }
  }
  return { ways, retrace, remove, box, places, size, up, normal: normal(size), bodies, layers, show, hide, light, perMetre: largest > 0 ? perMetre : null };
}

/** A body of another run: what is seen through. */
function ghost(body, index) {
  const material = new THREE.MeshStandardMaterial({
    color: shapes.colourOf(index), transparent: true, opacity: 0.28, depthWrite: false, ...shapes.METAL });
  body.traverse((part) => {
    if (!part.isMesh) return;
    Object.assign(part, { material, castShadow: false, receiveShadow: false });
    part.userData.name = `${film.bodies[index].name} of ${film.ghost.title}`;
  });
  return body;
}

/** A line so many pixels wide, through no places yet; nothing to hover over. */
function line(color, linewidth, opacity) {
  const material = new LineMaterial({ color, linewidth, opacity, transparent: true, depthWrite: opacity === 1 });
  const made = new Line2(new LineGeometry(), material);
  // What is strong goes over what is faint.
  made.renderOrder = opacity;
  made.raycast = () => {};
  return made;
}

/** The two points that a line goes between: on different bodies, named differently where it can be. */
function linePair(element, ends) {
  if (element.bodies.length < 2 || ends.length < 2) return null;
  const names = [...new Set(ends.map((m) => m.name))];
  const first = ends.find((m) => m.place === 0 && m.name === names[0]);
  const second = ends.find((m) => m.place === 1 && m.name === (names[1] ?? names[0]));
  return first && second ? [first, second] : null;
}

/** The next number of the form 1, 2 or 5 times a power of ten. */
function rounded(value) {
  const ten = 10 ** Math.floor(Math.log10(value));
  return [1, 2, 5, 10].map((k) => k * ten).find((k) => k >= value);
}
