// The page of a film: stage, camera, controls, charts.

import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { charts, digits } from "./charts.js";
import { film } from "./data.js";
import { floor } from "./floor.js";
import { icon } from "./icons.js";
import { colourOf } from "./shapes.js";
import { stage } from "./stage.js";

const id = (name) => document.getElementById(name);
const [start, end] = [film.times[0], film.times[film.times.length - 1]];
document.title = film.title;
id("title").textContent = film.title;

// Stage and light.
const canvas = id("stage");
const renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
renderer.setPixelRatio(devicePixelRatio);
renderer.shadowMap.enabled = true;
renderer.shadowMap.type = THREE.PCFShadowMap;
const scene = new THREE.Scene();
const set = stage(scene);
const middle = set.box.getCenter(new THREE.Vector3());
const radius = Math.max(0.5 * set.box.getSize(new THREE.Vector3()).length(), 0.5 * set.size);

scene.add(new THREE.HemisphereLight(0xffffff, 0xaab0c0, 2.1));
const sun = new THREE.DirectionalLight(0xffffff, 2.2);
const side = Math.abs(set.up.x) < 0.9 ? new THREE.Vector3(1, 0, 0) : new THREE.Vector3(0, 1, 0);
const right = side.clone().cross(set.up).normalize();
sun.position.copy(middle).addScaledVector(set.up, 3 * radius).addScaledVector(side, 1.4 * radius).addScaledVector(right, 1.8 * radius);
sun.target.position.copy(middle);
sun.castShadow = true;
sun.shadow.mapSize.set(2048, 2048);
Object.assign(sun.shadow.camera, { left: -2 * radius, right: 2 * radius, top: 2 * radius, bottom: -2 * radius, far: 8 * radius });
sun.shadow.radius = 3;
sun.shadow.normalBias = 0.01 * set.size;
scene.add(sun, sun.target);

const lowest = Math.min(...corners(set.box).map((corner) => corner.dot(set.up))) - 0.16 * set.size;
const { group: ground, grid, shade } = floor(radius);
ground.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), set.up);
ground.position.copy(middle).addScaledVector(set.up, lowest - middle.dot(set.up));
scene.add(ground);

function corners(box) {
  return [0, 1, 2, 3, 4, 5, 6, 7].map((k) => new THREE.Vector3(
    (k & 1 ? box.max : box.min).x, (k & 2 ? box.max : box.min).y, (k & 4 ? box.max : box.min).z));
}

// Cameras.
const cameras = {
  perspective: new THREE.PerspectiveCamera(32, 1, 0.01 * radius, 60 * radius),
  orthographic: new THREE.OrthographicCamera(-1, 1, 1, -1, -40 * radius, 40 * radius),
};
let camera = cameras.perspective;
let reach = radius;
/** The direction of a view that nobody has changed since: it stays fitted when the page changes its size. */
let fitted = null;
let controls;
function useCamera(next) {
  next.up.copy(set.up);
  next.position.copy(camera.position);
  const target = controls?.target.clone() ?? middle.clone();
  controls?.dispose();
  camera = next;
  controls = new OrbitControls(camera, canvas);
  controls.enableDamping = true;
  controls.dampingFactor = 0.12;
  controls.addEventListener("start", () => (fitted = null));
  controls.target.copy(target);
  resize();
}
const isotropic = () => set.up.clone().multiplyScalar(0.55).addScaledVector(side, 0.55).addScaledVector(right, 1);
/** The part of the stage's height, about its middle, that no controls are over. */
function freeHeight() {
  const box = canvas.getBoundingClientRect();
  const above = document.querySelector(".views").getBoundingClientRect().bottom - box.top;
  const below = box.bottom - document.querySelector(".layers").getBoundingClientRect().top;
  return Math.min(0.9, Math.max(0.5, 1 - (2 * Math.max(above, below)) / box.height));
}
/** Looks from a direction, as near as everything that moves stays in the picture. */
function fit(direction) {
  const way = (direction ?? camera.position.clone().sub(controls.target)).normalize();
  const aspect = canvas.clientWidth / canvas.clientHeight;
  const half = Math.tan((cameras.perspective.fov * Math.PI) / 360);
  // Axes of the picture, and what is free of controls: less at the sides than above and below.
  const across = set.up.clone().cross(way);
  if (across.lengthSq() < 1e-6) across.copy(right);
  across.normalize();
  const upward = way.clone().cross(across);
  const bounds = (axis) => {
    const far = set.places.map((place) => place.dot(axis));
    return [Math.min(...far), Math.max(...far)];
  };
  const [x, y] = [bounds(across), bounds(upward)];
  const centre = across.clone().multiplyScalar((x[0] + x[1]) / 2)
    .addScaledVector(upward, (y[0] + y[1]) / 2).addScaledVector(way, middle.dot(way));
  let distance = 0;
  const margin = 0.07 * set.size;
  const free = freeHeight();
  for (const place of set.places) {
    const off = place.clone().sub(centre);
    const wide = (Math.abs(off.dot(across)) + margin) / (0.9 * half * aspect);
    const high = (Math.abs(off.dot(upward)) + margin) / (free * half);
    distance = Math.max(distance, Math.max(wide, high) + off.dot(way));
  }
  fitted = way.clone();
  controls.target.copy(centre);
  camera.position.copy(centre).addScaledVector(way, distance);
  reach = distance * half;
  cameras.orthographic.zoom = 1;
  controls.update();
  resize();
}
function resize() {
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  renderer.setSize(width, height, false);
  const aspect = width / height;
  cameras.perspective.aspect = aspect;
  const half = reach;
  Object.assign(cameras.orthographic, { left: -half * aspect, right: half * aspect, top: half, bottom: -half });
  for (const each of Object.values(cameras)) each.updateProjectionMatrix();
  drawCharts(time);
}

// Time.
let time = start;
let playing = true;
let looping = true;
let speed = natural();
let previous = performance.now();
/** Real time where a film lasts for seconds, else a speed at which it does. */
function natural() {
  const duration = end - start;
  if (duration >= 1 && duration <= 60) return 1;
  return 10 ** Math.round(Math.log10(Math.max(duration, 1e-12) / 8));
}
const slider = id("slider");
const seek = (to) => {
  time = Math.min(end, Math.max(start, to));
  play(false);
};
function play(on) {
  if (on && time >= end) time = start;
  playing = on;
  id("play").innerHTML = icon(on ? "pause" : "play");
  id("play").setAttribute("aria-label", on ? "Pause" : "Play");
}
const drawCharts = charts(id("charts"), seek);

// Controls.
for (const name of ["loop", "theme", "list"]) id(name).insertAdjacentHTML("afterbegin", icon(name));
const speeds = [...new Set([0.01, 0.1, 0.25, 0.5, 1, 2, 5, 10, speed])].sort((a, b) => a - b);
for (const each of speeds) id("speed").add(new Option(`${+each.toPrecision(3)}×`, each, each === speed, each === speed));
id("speed").onchange = (event) => (speed = +event.target.value);
id("play").onclick = () => play(!playing);
id("loop").onclick = () => id("loop").setAttribute("aria-pressed", (looping = !looping));
slider.oninput = () => seek(start + slider.value * (end - start));
const views = {
  fit: () => fit(), iso: () => fit(isotropic()),
  x: () => fit(new THREE.Vector3(1, 0, 0)), y: () => fit(new THREE.Vector3(0, 1, 0)), z: () => fit(new THREE.Vector3(0, 0, 1)),
  flat: () => {
    useCamera(camera === cameras.perspective ? cameras.orthographic : cameras.perspective);
    id("flat").setAttribute("aria-pressed", camera === cameras.orthographic);
  },
};
for (const [name, act] of Object.entries(views)) id(name).onclick = act;
const shown = { reactions: film.arrows.length > 0 && film.showArrows, centres: true, points: true, traces: true, joints: true, forces: true };
for (const name of Object.keys(shown)) {
  const button = id(`show-${name}`);
  const apply = () => {
    set.layers[name].visible = shown[name];
    button.setAttribute("aria-pressed", shown[name]);
    id("scale").hidden = !shown.reactions;
  };
  button.onclick = () => {
    shown[name] = !shown[name];
    apply();
  };
  apply();
}
id("show-reactions").hidden = film.arrows.length === 0;
id("show-points").hidden = film.points.length === 0;
id("show-traces").hidden = film.traces.length === 0;
id("show-forces").hidden = !film.elements.some((element) => element.type === "force");
id("scale").textContent = `arrows: ${+digits(set.perMetre)} N to 1 m`;

// What can be hidden.
function entry(kind, index, said, colour) {
  const item = document.createElement("button");
  item.className = "item";
  item.setAttribute("aria-pressed", "true");
  if (colour !== undefined) item.style.setProperty("--colour", `#${colour.toString(16).padStart(6, "0")}`);
  item.innerHTML = "<i></i>";
  item.append(said);
  item.onclick = () => {
    const hidden = item.getAttribute("aria-pressed") === "true";
    item.setAttribute("aria-pressed", !hidden);
    set.hide(kind, index, hidden);
  };
  id("items").append(item);
}
film.bodies.forEach((body, k) => entry("body", k, body.name, colourOf(k)));
film.elements.forEach((element, k) => entry("element", k, `${element.name}: ${element.kind}`));
id("list").onclick = () => {
  const open = document.body.classList.toggle("listed");
  id("list").setAttribute("aria-pressed", open);
};

// Warnings of the run, where they happened.
for (const warning of film.warnings) {
  const line = document.createElement("button");
  line.className = "warning";
  line.title = warning.text;
  line.setAttribute("aria-expanded", false);
  line.textContent = `⚠ ${warning.text}`;
  id("warnings").append(line);
  // A line, so that the mechanism is seen; all of it after a click.
  line.onclick = () => {
    line.setAttribute("aria-expanded", line.getAttribute("aria-expanded") === "false");
    if (warning.time !== null) seek(warning.time);
  };
  if (warning.time === null) continue;
  const mark = document.createElement("button");
  mark.className = "mark";
  mark.title = warning.text;
  mark.style.left = `${(100 * (warning.time - start)) / (end - start || 1)}%`;
  mark.onclick = () => seek(warning.time);
  id("marks").append(mark);
}

// Light and dark.
const dark = matchMedia("(prefers-color-scheme: dark)");
function theme() {
  const isDark = document.documentElement.dataset.theme ? document.documentElement.dataset.theme === "dark" : dark.matches;
  grid.material.color.set(isDark ? 0x3a4254 : 0xb4bccb);
  grid.material.opacity = isDark ? 0.75 : 0.6;
  shade.material.opacity = isDark ? 0.4 : 0.16;
  drawCharts(time);
  return isDark;
}
dark.addEventListener("change", theme);
id("theme").onclick = () => {
  document.documentElement.dataset.theme = theme() ? "light" : "dark";
  theme();
};

// Names on hover.
const ray = new THREE.Raycaster();
const label = id("label");
canvas.addEventListener("pointermove", (event) => {
  const box = canvas.getBoundingClientRect();
  const at = new THREE.Vector2(((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2);
  ray.setFromCamera(at, camera);
  // What is drawn over everything is named before what it lies in.
  const hits = ray.intersectObjects(scene.children, true).filter(({ object }) => object.userData.name && seen(object));
  const hit = hits.sort((a, b) => b.object.renderOrder - a.object.renderOrder || a.distance - b.distance)[0];
  label.hidden = !hit;
  if (!hit) return;
  label.textContent = hit.object.userData.name;
  label.style.translate = `${event.clientX + 14}px ${event.clientY + 14}px`;
});
canvas.addEventListener("pointerleave", () => (label.hidden = true));
const seen = (object) => object === null || (object.visible && seen(object.parent));

// Keys.
const frame = () => (end - start) / Math.max(1, film.times.length - 1);
const keys = {
  " ": () => play(!playing), ArrowLeft: () => seek(time - frame()), ArrowRight: () => seek(time + frame()),
  Home: () => seek(start), End: () => seek(end), l: () => id("loop").click(), f: views.fit, i: views.iso,
  x: views.x, y: views.y, z: views.z, o: views.flat, r: () => id("show-reactions").click(),
  t: () => id("show-traces").click(), p: () => id("show-points").click(), h: () => id("list").click(), d: () => id("theme").click(),
};
addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.tagName === "SELECT") return;
  const act = keys[event.key];
  if (!act) return;
  event.preventDefault();
  act();
});

new ResizeObserver(() => (fitted ? fit(fitted.clone()) : resize())).observe(canvas);
useCamera(camera);
fit(isFlat() ?? isotropic());
theme();
play(!matchMedia("(prefers-reduced-motion: reduce)").matches);

/** The direction to look from at what moves in a plane: nearly along its normal. */
function isFlat() {
  const extent = set.box.getSize(new THREE.Vector3());
  const axes = [new THREE.Vector3(1, 0, 0), new THREE.Vector3(0, 1, 0), new THREE.Vector3(0, 0, 1)];
  const normal = axes.find((_, k) => extent.getComponent(k) < 0.02 * set.size);
  if (!normal || Math.abs(normal.dot(set.up)) > 0.9) return null;
  const aside = normal.clone().cross(set.up);
  return normal.clone().addScaledVector(set.up, 0.22).addScaledVector(aside, -0.3);
}

// An address such as `film.html#t=0.5` opens at that time and stands still; the page then says
// which part of the stage was drawn on, for whoever looks at it without eyes.
const asked = /[#&]t=([-+.\de]+)/.exec(location.hash);
if (asked) seek(+asked[1]);
function drawn() {
  const gl = renderer.getContext();
  const [width, height] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
  const pixels = new Uint8Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  let count = 0;
  for (let k = 3; k < pixels.length; k += 4) count += pixels[k] > 200;
  return count / (width * height);
}

function draw(now) {
  // The first picture may be of a time before the script's.
  const passed = Math.min(0.1, Math.max(0, (now - previous) / 1000));
  previous = now;
  if (playing) {
    time += passed * speed;
    if (time > end) {
      time = looping ? start + ((time - start) % (end - start || 1)) : end;
      if (!looping) play(false);
    }
  }
  set.show(time);
  controls.update();
  slider.value = (time - start) / (end - start || 1);
  id("time").textContent = `${time.toFixed(end - start < 1 ? 4 : 2)} s`;
  drawCharts(time);
  renderer.render(scene, camera);
}
draw(previous);
if (asked) document.body.dataset.drawn = drawn().toFixed(4);
renderer.setAnimationLoop(draw);
