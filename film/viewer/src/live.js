// The module of a page in which the mechanism runs: steps in wall time, and what was reached lately.

import { bytes, film, POSE } from "./data.js";

/** How many pictures are kept: twenty seconds of a screen. */
const KEPT = 1200;
/** How long steps may take in a picture (ms), and how many are taken between two looks at the clock, at first. */
const [BUDGET, AT_ONCE] = [11, 4];
/** The estimated error, in sizes of the mechanism after ten seconds, from which on it is said. */
const WRONG = 0.01;
/** What of a scene does not change with the time. */
const SHAPE = ["markers", "points", "shapes", "wheels", "racks"];

/** The last frames: views of arrays that are twice as long, so that few are moved. */
class History {
  constructor(width) {
    this.width = width;
    this.times = new Float64Array(2 * KEPT);
    this.poses = new Float32Array(2 * KEPT * width);
    this.values = film.readings.map(() => new Float32Array(2 * KEPT));
    this.clear();
  }
  clear() {
    [this.first, this.end] = [0, 0];
  }
  /** Adds a frame; how many were dropped for it. */
  add(time, poses, readings) {
    if (this.end === 2 * KEPT) {
      for (const [array, width] of [[this.times, 1], [this.poses, this.width], ...this.values.map((values) => [values, 1])])
        array.copyWithin(0, this.first * width, this.end * width);
      [this.first, this.end] = [0, this.end - this.first];
    }
    this.put(this.end, time, poses, readings);
    this.end += 1;
    const dropped = Math.max(0, this.end - this.first - KEPT);
    this.first += dropped;
    return dropped;
  }
  put(frame, time, poses, readings) {
    this.times[frame] = time;
    this.poses.set(poses, frame * this.width);
    this.values.forEach((values, k) => (values[frame] = readings[k]));
  }
  /** Hands the frames to what draws. */
  show() {
    const { first, end, width } = this;
    film.times = this.times.subarray(first, end);
    film.poses = this.poses.subarray(first * width, end * width);
    film.readings.forEach((reading, k) => (reading.values = this.values[k].subarray(first, end)));
  }
}

/** Calls of a module, as exceptions and numbers. */
function border(exports) {
  /** A part of the memory, which a call may replace: the place is asked for first. */
  const part = (Type, place, length) => new Type(exports.memory.buffer, place, length);
  const text = () => new TextDecoder().decode(part(Uint8Array, exports.holonom_text(), exports.holonom_text_length()));
  /** What a call left; an exception where it was refused, or where the program has ended. */
  const call = (name, ...given) => {
    let refused;
    try {
      refused = exports[`holonom_${name}`](...given);
    } catch (error) {
      throw new Error(`the program has ended: ${text() || error.message}`);
    }
    if (refused) throw new Error(text());
  };
  return {
    call,
    json: (name) => (call(name), JSON.parse(text())),
    numbers: () => part(Float64Array, exports.holonom_numbers(), exports.holonom_numbers_length()),
  };
}

/** Starts the module of the page; nothing where it has none. `changed` is called where the mechanism has another shape,
 * `added` for each frame with how many were kept and dropped. */
export async function live({ changed, added }) {
  const place = document.getElementById("live");
  if (!place) return null;
  const { instance } = await WebAssembly.instantiate(bytes(place.textContent), {});
  place.remove();
  instance.exports.main(0, 0);
  const { call, json, numbers } = border(instance.exports);
  const { step, sliders } = json("controls");
  const width = POSE * film.bodies.length;
  const history = new History(width);
  const shape = (scene) => JSON.stringify(SHAPE.map((name) => scene[name]));
  let drawn = shape(film);
  let target = 0;
  let [time, error, values] = [0, 0, []];
  let atOnce = AT_ONCE;
  /** Parts of the wall time that were kept up with, lately. */
  let pace = 1;

  /** Reads the state; a frame of its own unless the time is that of the last one. */
  function read() {
    const all = numbers();
    [time, error] = all;
    values = Array.from(all.subarray(2, 2 + sliders.length));
    const poses = all.subarray(2 + sliders.length, 2 + sliders.length + width);
    const readings = all.subarray(2 + sliders.length + width);
    const count = history.end - history.first;
    if (count && time === history.times[history.end - 1]) {
      history.put(history.end - 1, time, poses, readings);
      history.show();
      added(count - 1, 0);
    } else {
      const dropped = history.add(time, poses, readings);
      history.show();
      added(count - dropped, dropped);
    }
  }
  /** Begins the history anew, of the state that is there. */
  function begin() {
    history.clear();
    read();
    target = time;
  }
  function redraw() {
    const scene = json("scene");
    if (shape(scene) === drawn) return read();
    drawn = shape(scene);
    for (const name of SHAPE) film[name] = scene[name];
    begin();
    changed();
  }
  begin();

  return {
    step, sliders,
    get time() { return time; },
    get values() { return values; },
    get pace() { return pace; },
    get isWrong() { return error > WRONG; },
    get error() { return error; },
    /** Goes on by a wall time (s) in steps; the time of the picture. An exception says why a step could not be taken. */
    advance(passed) {
      target += passed;
      const from = time;
      let left = Math.ceil((target - time) / step - 1e-6);
      const began = performance.now();
      let before = began;
      try {
        while (left > 0) {
          const count = Math.min(left, atOnce);
          call("advance", count);
          left -= count;
          const now = performance.now();
          if (now - before < 0.15 * BUDGET) atOnce = Math.min(4096, 2 * atOnce);
          else if (now - before > 0.5 * BUDGET) atOnce = Math.max(1, atOnce >> 1);
          before = now;
          if (now - began > BUDGET) break;
        }
      } finally {
        read();
        if (passed > 0) pace += 0.1 * (Math.min(1, left > 0 ? (time - from) / passed : 1) - pace);
        if (left > 0) target = time;
      }
      return Math.min(target, time);
    },
    /** Takes so many steps at once. */
    steps(count) {
      try {
        call("advance", count);
      } finally {
        read();
        target = time;
      }
    },
    /** Moves a slider. */
    set(place, value) {
      call("set", place, value);
      if (sliders[place].group === "Start") begin();
      else if (sliders[place].group === "Parameters") redraw();
      else read();
    },
    restart() {
      call("restart");
      begin();
    },
    /** Position (m) and Euler parameters of all bodies, in double precision. */
    poses: () => Array.from(numbers().subarray(2 + sliders.length, 2 + sliders.length + width)),
  };
}
