// The page of a film: stage, camera, controls, charts.

import * as THREE from "three";
import { charts, digits } from "./charts.js";
import { film } from "./data.js";
import { floor } from "./floor.js";
import { icon } from "./icons.js";
import { live } from "./live.js";
import { picture, records, video } from "./save.js";
import { selection } from "./select.js";
import { colourOf } from "./shapes.js";
import { panel } from "./sliders.js";
import { stage } from "./stage.js";
import { triad } from "./triad.js";
import { views } from "./views.js";

const id = (name) => document.getElementById(name);
// Those of what is shown: of a mechanism that runs they go on.
const start = () => film.times[0];
const end = () => film.times[film.times.length - 1];
let time = start();
/** The module of a page in which the mechanism runs, and its sliders. */
let [running, sliders] = [null, null];
let drawCharts;
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
const show = views(canvas, renderer, { set, middle, radius, side, right }, () => drawCharts?.(time));
const corner = triad(id("triad"), canvas, renderer);

// Time.
let playing = true;
let looping = true;
let speed = natural();
let previous = performance.now();
/** Real time where a film lasts for seconds, else a speed at which it does. */
function natural() {
  const duration = end() - start();
  if (duration >= 1 && duration <= 60) return 1;
  return 10 ** Math.round(Math.log10(Math.max(duration, 1e-12) / 8));
}
const decimals = end() - start() < 1 ? 4 : 2;
const slider = id("slider");
const seek = (to) => {
  time = Math.min(end(), Math.max(start(), to));
  play(false);
};
function play(on) {
  if (on && running) time = end();
  else if (on && time >= end()) time = start();
  playing = on;
  id("play").innerHTML = icon(on ? "pause" : "play");
  id("play").setAttribute("aria-label", on ? "Pause" : "Play");
}
const graphs = charts(id("charts"), seek, set.size);
drawCharts = graphs.show;

// Controls.
for (const name of ["loop", "theme", "list"]) id(name).insertAdjacentHTML("afterbegin", icon(name));
const speeds = [...new Set([0.01, 0.1, 0.25, 0.5, 1, 2, 5, 10, speed])].sort((a, b) => a - b);
for (const each of speeds) id("speed").add(new Option(`${+each.toPrecision(3)}×`, each, each === speed, each === speed));
id("speed").onchange = (event) => (speed = +event.target.value);
id("play").onclick = () => play(!playing);
id("loop").onclick = () => id("loop").setAttribute("aria-pressed", (looping = !looping));
slider.oninput = () => seek(start() + slider.value * (end() - start()));
const along = (...at) => () => show.fit(new THREE.Vector3(...at));
const buttons = {
  fit: () => show.fit(), iso: () => show.fit(show.corner()), x: along(1, 0, 0), y: along(0, 1, 0), z: along(0, 0, 1),
  flat: () => id("flat").setAttribute("aria-pressed", show.flatten()),
  png: () => onPaper(() => picture(canvas)),
  video: record,
};
for (const [name, act] of Object.entries(buttons)) id(name).onclick = act;
id("video").hidden = !records();

/** Draws on the colour of the page, which is not in the canvas, and does something with the picture. */
function onPaper(act) {
  scene.background = new THREE.Color(isDark() ? 0x171c25 : 0xf3f5f9);
  render();
  act?.();
  if (act) scene.background = null;
}
/** Saves a video from the start to the end, or what there is of it at a second click. */
let stopVideo = null;
function record() {
  if (stopVideo) {
    stopVideo();
    stopVideo = scene.background = null;
    id("video").setAttribute("aria-pressed", false);
    return;
  }
  if (!running) time = start();
  onPaper();
  stopVideo = video(canvas);
  id("video").setAttribute("aria-pressed", true);
  play(true);
}
const shown = { reactions: film.arrows.length > 0 && film.showArrows, centres: film.meshes.length === 0, frames: false, ghost: true, points: true, traces: true, joints: true, forces: true };
for (const name of Object.keys(shown)) {
  const button = id(`show-${name}`);
  const apply = () => {
    set.layers[name].visible = shown[name];
    button.setAttribute("aria-pressed", shown[name]);
    id("scale").hidden = !shown.reactions || set.perMetre === null;
  };
  button.onclick = () => {
    shown[name] = !shown[name];
    apply();
  };
  apply();
}
id("show-reactions").hidden = film.arrows.length === 0;
id("show-ghost").hidden = !film.ghost;
id("show-points").hidden = film.points.length === 0;
id("show-traces").hidden = film.traces.length === 0;
id("show-forces").hidden = !film.elements.some((element) => element.type === "force");
if (set.perMetre !== null) id("scale").textContent = `arrows: ${+digits(set.perMetre)} N to 1 m`;

// What can be hidden, and what is.
const hidden = new Map();
function entry(kind, index, said, colour) {
  const item = document.createElement("button");
  item.className = "item";
  item.setAttribute("aria-pressed", "true");
  if (colour !== undefined) item.style.setProperty("--colour", `#${colour.toString(16).padStart(6, "0")}`);
  item.innerHTML = "<i></i>";
  item.append(said);
  item.title = "Click to hide or show, double click to select";
  item.ondblclick = () => {
    if (item.getAttribute("aria-pressed") !== "true") item.click();
    chosen.select({ kind, index });
  };
  item.onclick = () => {
    const isShown = item.getAttribute("aria-pressed") === "true";
    item.setAttribute("aria-pressed", !isShown);
    if (isShown) hidden.set(item, [kind, index]);
    else hidden.delete(item);
    set.hide(kind, index, isShown);
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
  mark.style.left = `${(100 * (warning.time - start())) / (end() - start() || 1)}%`;
  mark.onclick = () => seek(warning.time);
  id("marks").append(mark);
}

// Light and dark.
const dark = matchMedia("(prefers-color-scheme: dark)");
function isDark() {
  const { theme: asked } = document.documentElement.dataset;
  return asked ? asked === "dark" : dark.matches;
}
function theme() {
  grid.material.color.set(isDark() ? 0x3a4254 : 0xb4bccb);
  grid.material.opacity = isDark() ? 0.75 : 0.6;
  shade.material.opacity = isDark() ? 0.4 : 0.16;
  drawCharts(time);
}
dark.addEventListener("change", theme);
id("theme").onclick = () => {
  document.documentElement.dataset.theme = isDark() ? "light" : "dark";
  theme();
};

// What is under the pointer, and what is selected.
const chosen = selection(canvas, scene, set, () => show.camera, (lines) => graphs.add("N", lines), { follow: show.follow });

// Keys.
const frame = () => (end() - start()) / Math.max(1, film.times.length - 1);
const click = (name) => () => id(name).click();
const keys = {
  " ": () => play(!playing), arrowleft: () => seek(time - frame()), arrowright: () => seek(time + frame()),
  home: () => seek(start()), end: () => seek(end()), escape: () => chosen.select(null),
  l: click("loop"), f: click("fit"), i: click("iso"), x: click("x"), y: click("y"), z: click("z"), o: click("flat"),
  s: click("png"), v: click("video"), c: () => chosen.selected?.kind === "body" && id("follow").click(),
  r: click("show-reactions"), t: click("show-traces"), p: click("show-points"), a: click("show-frames"),
  g: click("show-ghost"), h: click("list"), d: click("theme"), n: () => running && id("restart").click(),
};
addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.tagName === "SELECT" || event.target.type === "number") return;
  // Caps Lock makes capitals of letters.
  const act = keys[event.key.toLowerCase()];
  if (!act) return;
  event.preventDefault();
  act();
});

show.fit(show.first());
theme();
play(!matchMedia("(prefers-reduced-motion: reduce)").matches);

// An address such as `film.html#t=0.5&view=z&select=crank` opens at that time and stands still; the page then says
// which part of the stage was drawn on, for whoever looks at it without eyes.
const view = /[#&]view=([a-z]+)/.exec(location.hash)?.[1];
if (view in buttons) buttons[view]();
const part = /[#&]select=(\w+)/.exec(location.hash)?.[1];
for (const kind of ["body", "element"]) {
  const index = film[{ body: "bodies", element: "elements" }[kind]].findIndex(({ name }) => name === part);
  if (index >= 0) chosen.select({ kind, index });
}
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
  if (running) go(passed * speed);
  else if (playing) {
    time += passed * speed;
    if (time > end()) {
      if (stopVideo) {
        record();
        play(false);
      }
      time = looping && playing ? start() + ((time - start()) % (end() - start() || 1)) : end();
      if (time === end()) play(false);
    }
  }
  set.show(time);
  show.update();
  slider.value = (time - start()) / (end() - start() || 1);
  id("time").textContent = `${time.toFixed(decimals)} s`;
  drawCharts(time);
  chosen.read(time);
  render();
}
function render() {
  renderer.render(scene, show.camera);
  corner(show.camera);
}
draw(previous);
if (asked) document.body.dataset.drawn = drawn().toFixed(4);
renderer.setAnimationLoop(draw);

// A mechanism that runs: what was recorded is shown until its module has started.
function go(wall) {
  const was = running.time;
  sliders.apply();
  if (playing) {
    try {
      time = running.advance(wall);
    } catch (error) {
      tell("fault", `${running.time.toPrecision(6)} s: ${error.message}`);
      time = end();
      play(false);
    }
  } else if (running.time !== was || time > end()) time = end();
  tell("error", running.isWrong
    ? `Steps of ${running.step} s are too long here: after ten seconds positions are off by about ${digits(100 * running.error)} % of the mechanism.`
    : null);
  tell("pace", playing && running.pace < 0.9 ? `The run takes ${digits(1 / running.pace)} times as long as the speed that is asked for.` : null);
}
/** Says something of the run, or takes it away. */
function tell(what, text) {
  let line = id(`told-${what}`);
  if (text === null) return void line?.remove();
  if (!line) {
    line = document.createElement("button");
    Object.assign(line, { id: `told-${what}`, className: "warning" });
    line.setAttribute("role", "alert");
    line.setAttribute("aria-expanded", what !== "pace");
    line.onclick = () => line.setAttribute("aria-expanded", line.getAttribute("aria-expanded") === "false");
    id("warnings").append(line);
  }
  line.title = text;
  line.textContent = `⚠ ${text}`;
}
/** Draws the mechanism anew: a parameter has changed its shape. */
function rebuild() {
  const { layers } = set;
  set.remove();
  const anew = stage(scene, set);
  for (const [name, layer] of Object.entries(layers)) anew.layers[name].visible = layer.visible;
  Object.assign(set, anew);
  for (const [kind, index] of hidden.values()) set.hide(kind, index, true);
  set.light(chosen.selected);
  if (id("follow").getAttribute("aria-pressed") === "true") show.follow(set.bodies[chosen.selected.index]);
}
async function run() {
  const module = await live({ changed: rebuild, added: (known, gone) => set.retrace(known, gone) });
  if (!module) return;
  running = module;
  const restarted = () => {
    tell("fault", null);
    graphs.unzoom();
    if (playing) play(true);
    else time = end();
  };
  sliders = panel(module, { restarted, refused: (text) => {
    id("refused").hidden = text === null;
    id("refused").textContent = text ?? "";
    if (text === null) tell("fault", null);
  } });
  id("loop").hidden = true;
  id("marks").hidden = true;
  id("play").title = "Run or pause (space)";
  time = end();
  // For scripts around the page.
  globalThis.holonom = {
    get time() { return module.time; },
    sliders: module.sliders,
    get values() { return module.values; },
    set(name, value) {
      const place = module.sliders.findIndex((each) => each.name === name);
      if (place < 0) throw new Error(`no slider is called ${name}`);
      module.set(place, value);
      sliders.show();
    },
    restart: () => id("restart").click(),
    steps(count) {
      module.steps(count);
      time = end();
    },
    poses: () => module.poses(),
  };
  document.body.dataset.live = "runs";
}
run().catch((error) => {
  tell("fault", `The mechanism does not run here; the film shows how it began. ${error.message}`);
  document.body.dataset.live = error.message;
});
