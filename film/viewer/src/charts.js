// Readings over time: a chart for each unit, with a cursor at the time of the picture. The wheel
// zooms all of them, a double click shows the whole run.

import { marks, range, said } from "./axis.js";
import { film, frameAt } from "./data.js";
import { colourOf } from "./shapes.js";

const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const hex = (colour) => `#${colour.toString(16).padStart(6, "0")}`;

/** A number in few digits. */
export const digits = (value) => {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e5)) return value.toExponential(2);
  return value.toFixed(size >= 100 ? 1 : size >= 10 ? 2 : 3);
};

/** Whether an angle begins anew between two frames. */
const wraps = (unit, from, to) => unit === "rad" && Math.abs(to - from) > 1.5 * Math.PI;

const [LEFT, RIGHT] = [64, 12];

/** A chart of lines of one unit, at the end of what is in a place. */
function chart(place, unit, lines) {
  const box = document.createElement("figure");
  const legend = document.createElement("figcaption");
  const canvas = document.createElement("canvas");
  canvas.title = "Drag to seek, wheel to zoom, double click for the whole run";
  box.append(legend, canvas);
  place.append(box);
  const values = lines.map((line, k) => {
    const item = document.createElement("span");
    item.className = "reading";
    item.style.setProperty("--colour", hex(colourOf(k)));
    const value = document.createElement("output");
    item.append(line.name, " ", value, ` ${unit}`);
    legend.append(item);
    return value;
  });
  return { box, unit, lines, canvas, values };
}

export function charts(place, seek, size) {
  const whole = () => [film.times[0], film.times[film.times.length - 1]];
  /** What is zoomed to of the run (s). */
  let zoomed = null;
  const at = (canvas, x) => {
    const shown = zoomed ?? whole();
    const width = canvas.clientWidth - LEFT - RIGHT;
    return shown[0] + Math.min(1, Math.max(0, (x - LEFT) / width)) * (shown[1] - shown[0]);
  };
  function zoom(about, by) {
    const [start, end] = whole();
    const shown = zoomed ?? [start, end];
    const frame = (end - start) / Math.max(1, film.times.length - 1);
    const by1 = Math.max(by, (4 * frame) / (shown[1] - shown[0] || 1));
    const [from, to] = shown.map((edge) => about + by1 * (edge - about));
    zoomed = to - from >= end - start ? null : [Math.max(start, from), Math.min(end, to)];
  }
  function listen({ canvas }) {
    const go = (event) => event.buttons && seek(at(canvas, event.offsetX));
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      go(event);
    });
    canvas.addEventListener("pointermove", go);
    canvas.addEventListener("dblclick", () => (zoomed = null));
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      zoom(at(canvas, event.offsetX), 1.2 ** Math.sign(event.deltaY));
    }, { passive: false });
  }
  const units = [...new Set(film.readings.map((reading) => reading.unit))];
  const drawn = units.map((unit) => chart(place, unit, film.readings.filter((reading) => reading.unit === unit)));
  drawn.forEach(listen);
  let added = null;
  /** Shows lines of what was selected in a chart of their own; none without lines. */
  function add(unit, lines) {
    if (added) {
      added.box.remove();
      drawn.splice(drawn.indexOf(added), 1);
      added = null;
    }
    if (lines?.length) {
      added = chart(place, unit, lines);
      listen(added);
      drawn.push(added);
      added.box.scrollIntoView?.({ block: "nearest" });
    }
    place.hidden = drawn.length === 0;
  }
  add();

  function draw({ lines, canvas, unit }, time) {
    const { times } = film;
    const shown = zoomed ?? whole();
    const ratio = devicePixelRatio;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (canvas.width !== width * ratio || canvas.height !== height * ratio) {
      [canvas.width, canvas.height] = [width * ratio, height * ratio];
    }
    const pen = canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    const [first, last] = [frameAt(shown[0]).low, frameAt(shown[1]).next];
    let [low, high] = [Infinity, -Infinity];
    for (const { values } of lines) {
      for (let frame = first; frame <= last; frame++) {
        const value = values[frame];
        if (Number.isFinite(value)) [low, high] = [Math.min(low, value), Math.max(high, value)];
      }
    }
    if (!(low <= high)) return;
    [low, high] = range(unit, low, high, size);
    const [top, bottom, right] = [8, height - 22, width - RIGHT];
    const x = (t) => LEFT + ((t - shown[0]) / (shown[1] - shown[0] || 1)) * (right - LEFT);
    const y = (v) => bottom - ((v - low) / (high - low)) * (bottom - top);
    pen.font = "11px system-ui, sans-serif";
    pen.fillStyle = css("--faint");
    pen.strokeStyle = css("--line");
    pen.lineWidth = 1;
    pen.textBaseline = "middle";
    pen.textAlign = "right";
    const levels = marks(low, high, 4);
    for (const mark of levels.at) {
      pen.beginPath();
      pen.moveTo(LEFT, Math.round(y(mark)) + 0.5);
      pen.lineTo(right, Math.round(y(mark)) + 0.5);
      pen.stroke();
      pen.fillText(said(mark, levels.step), LEFT - 8, y(mark));
    }
    pen.textAlign = "center";
    const instants = marks(...shown, Math.max(2, width / 110));
    for (const mark of instants.at) {
      const text = `${said(mark, instants.step)} s`;
      const half = pen.measureText(text).width / 2;
      pen.fillText(text, Math.min(x(mark), width - half), height - 9);
    }
    pen.save();
    pen.beginPath();
    pen.rect(LEFT, 0, right - LEFT + 1, height);
    pen.clip();
    lines.forEach(({ values }, k) => {
      pen.strokeStyle = hex(colourOf(k));
      pen.lineWidth = 1.8;
      pen.lineJoin = "round";
      pen.beginPath();
      let on = false;
      for (let frame = first; frame <= last; frame++) {
        const value = values[frame];
        const goesOn = on && !wraps(unit, values[frame - 1], value);
        on = Number.isFinite(value);
        if (on) pen[goesOn ? "lineTo" : "moveTo"](x(times[frame]), y(value));
      }
      pen.stroke();
    });
    pen.strokeStyle = css("--text");
    pen.globalAlpha = 0.55;
    pen.beginPath();
    pen.moveTo(x(time), top);
    pen.lineTo(x(time), bottom);
    pen.stroke();
    pen.restore();
  }

  const show = (time) => {
    const { low, next, part } = frameAt(time);
    for (const each of drawn) {
      draw(each, time);
      each.lines.forEach(({ values }, k) => {
        const between = values[low] + (part ? part * (values[next] - values[low]) : 0);
        const value = wraps(each.unit, values[low], values[next]) ? values[part < 0.5 ? low : next] : between;
        each.values[k].textContent = digits(value);
      });
    }
  };
  return { show, add, unzoom: () => (zoomed = null) };
}
