// Names under the pointer, and the body, joint or force that is selected: what is read of it.

import * as THREE from "three";
import { digits } from "./charts.js";
import { film, frameAt, LOAD } from "./data.js";
import { poseIn } from "./reach.js";

const id = (name) => document.getElementById(name);
/** How far a pointer may move in a click (px), and how long a name stays after a touch (ms). */
const [STILL, STAYS] = [5, 2500];

/** `camera` gives the camera of the picture; `act` says what follows and hides. */
export function selection(canvas, scene, set, camera, chart, act) {
  const ray = new THREE.Raycaster();
  const label = id("label");
  const seen = (object) => object === null || (object.visible && seen(object.parent));
  /** What is drawn over everything is found before what it lies in. */
  function under(event) {
    const box = canvas.getBoundingClientRect();
    ray.setFromCamera(new THREE.Vector2(((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2), camera());
    const hits = ray.intersectObjects(scene.children, true).filter(({ object }) => object.userData.name && seen(object));
    return hits.sort((a, b) => b.object.renderOrder - a.object.renderOrder || a.distance - b.distance)[0]?.object;
  }
  function name(event) {
    const object = under(event);
    label.hidden = !object;
    if (!object) return;
    label.textContent = object.userData.name;
    label.style.translate = `${Math.min(event.clientX + 14, innerWidth - label.offsetWidth - 8)}px ${Math.min(event.clientY + 14, innerHeight - label.offsetHeight - 8)}px`;
  }
  let pressed = null;
  let timer;
  canvas.addEventListener("pointermove", (event) => {
    if (event.pointerType !== "touch") name(event);
    else if (pressed && Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) > STILL) label.hidden = true;
  });
  canvas.addEventListener("pointerleave", (event) => event.pointerType === "touch" || (label.hidden = true));
  canvas.addEventListener("pointerdown", (event) => {
    pressed = { x: event.clientX, y: event.clientY };
    if (event.pointerType !== "touch") return;
    name(event);
    clearTimeout(timer);
    timer = setTimeout(() => (label.hidden = true), STAYS);
  });
  canvas.addEventListener("pointerup", (event) => {
    if (!pressed || Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) > STILL) return;
    let object = under(event) ?? null;
    while (object && !object.userData.part) object = object.parent;
    select(object?.userData.part ?? null);
  });

  let selected = null;
  function select(part) {
    selected = part;
    set.light(part);
    id("reading").hidden = !part;
    act.follow(null);
    id("follow").setAttribute("aria-pressed", false);
    if (!part) return void chart(null);
    const { name, kind, bodies, particle } = film[part.kind === "body" ? "bodies" : "elements"][part.index];
    const on = bodies?.map((body) => (body === null ? "ground" : film.bodies[body].name));
    id("reading-name").textContent = name;
    id("reading-kind").textContent = part.kind === "body" ? (particle ? "particle" : "body") : `${kind} of ${on.join(" and ")}`;
    id("follow").hidden = part.kind !== "body";
    const arrow = part.kind === "element" ? film.arrows.findIndex(({ joint }) => joint === part.index) : -1;
    chart(arrow < 0 ? null : reaction(name, arrow));
  }
  id("unselect").onclick = () => select(null);
  id("follow").onclick = () => {
    const on = id("follow").getAttribute("aria-pressed") !== "true";
    act.follow(on ? set.bodies[selected.index] : null);
    id("follow").setAttribute("aria-pressed", on);
  };

  /** Rows of what is read at a time. */
  function rows(time) {
    const { low, next, part } = frameAt(time);
    if (selected.kind === "body") {
      const [[a, p], [b, q]] = [low, next].map((frame) => poseIn(frame, selected.index));
      const step = film.times[next] - film.times[low];
      const turned = 2 * Math.acos(Math.min(1, Math.abs(p.dot(q))));
      const at = a.clone().lerp(b, part);
      return [
        ...["x", "y", "z"].map((axis) => [axis, at[axis], "m"]),
        ...(step > 0 ? [["speed", a.distanceTo(b) / step, "m/s"]] : []),
        ...(step > 0 && !film.bodies[selected.index].particle ? [["angular speed", turned / step, "rad/s"]] : []),
      ];
    }
    const arrow = film.arrows.findIndex(({ joint }) => joint === selected.index);
    if (arrow < 0) return [];
    const first = ((part < 0.5 ? low : next) * film.arrows.length + arrow) * LOAD + 3;
    const force = film.loads.subarray(first, first + 3);
    return [["reaction", Math.hypot(...force), "N"], ...["x", "y", "z"].map((axis, k) => [axis, force[k], "N"])];
  }
  function read(time) {
    if (!selected) return;
    id("reading-rows").replaceChildren(...rows(time).flatMap((cells) => cells.map((cell) => {
      const made = document.createElement("span");
      made.textContent = typeof cell === "number" ? digits(cell) : cell;
      return made;
    })));
  }
  return { select, read, get selected() { return selected; } };
}

/** The lines of the reaction of a joint: its size, and its parts along global axes. */
function reaction(name, arrow) {
  const part = (k) => Float32Array.from(film.times, (_, frame) => {
    const first = (frame * film.arrows.length + arrow) * LOAD + 3;
    const force = film.loads.subarray(first, first + 3);
    return k === null ? Math.hypot(...force) : force[k];
  });
  return [{ name: `reaction of ${name}`, values: part(null) }, ...["x", "y", "z"].map((axis, k) => ({ name: axis, values: part(k) }))];
}
