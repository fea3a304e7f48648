// Readings over time: a chart for each unit, with a cursor at the time of the picture.

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

/** Round marks on an axis. */
function marks(low, high, count) {
  const raw = (high - low) / count || 1;
  const ten = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((k) => k * ten).find((k) => k >= 0.7 * raw);
  const found = [];
  for (let mark = Math.ceil(low / step) * step; mark <= high + 1e-9 * step; mark += step)
    found.push(Math.abs(mark) < 1e-9 * step ? 0 : mark);
  return found;
}

export function charts(place, seek) {
  const units = [...new Set(film.readings.map((reading) => reading.unit))];
  const drawn = units.map((unit) => {
    const lines = film.readings.filter((reading) => reading.unit === unit);
    const box = document.createElement("figure");
    const legend = document.createElement("figcaption");
    const canvas = document.createElement("canvas");
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
    return { unit, lines, canvas, values };
  });
  place.hidden = drawn.length === 0;

  const { times } = film;
  const [start, end] = [times[0], times[times.length - 1]];
  const left = 56;
  const from = (canvas, x) => {
    const width = canvas.clientWidth - left - 12;
    return start + Math.min(1, Math.max(0, (x - left) / width)) * (end - start);
  };
  for (const { canvas } of drawn) {
    const go = (event) => event.buttons && seek(from(canvas, event.offsetX));
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      go(event);
    });
    canvas.addEventListener("pointermove", go);
  }

  function draw({ lines, canvas, unit }, time) {
    const ratio = devicePixelRatio;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (canvas.width !== width * ratio || canvas.height !== height * ratio) {
      [canvas.width, canvas.height] = [width * ratio, height * ratio];
    }
    const pen = canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    let [low, high] = [Infinity, -Infinity];
    for (const { values } of lines) {
      for (const value of values) {
        if (!Number.isFinite(value)) continue;
        [low, high] = [Math.min(low, value), Math.max(high, value)];
      }
    }
    if (!(low <= high)) return;
    const slack = 0.08 * (high - low) || 0.1 * Math.abs(high) || 1;
    [low, high] = [low - slack, high + slack];
    const [top, bottom] = [8, height - 22];
    const x = (t) => left + ((t - start) / (end - start || 1)) * (width - left - 12);
    const y = (v) => bottom - ((v - low) / (high - low)) * (bottom - top);
    pen.font = "11px system-ui, sans-serif";
    pen.fillStyle = css("--faint");
    pen.strokeStyle = css("--line");
    pen.lineWidth = 1;
    pen.textBaseline = "middle";
    pen.textAlign = "right";
    for (const mark of marks(low, high, 4)) {
      pen.beginPath();
      pen.moveTo(left, Math.round(y(mark)) + 0.5);
      pen.lineTo(width - 12, Math.round(y(mark)) + 0.5);
      pen.stroke();
      pen.fillText(digits(mark).replace(/\.?0+$/, ""), left - 8, y(mark));
    }
    pen.textAlign = "center";
    for (const mark of marks(start, end, Math.max(2, width / 110))) {
      const said = `${+mark.toPrecision(6)} s`;
      const half = pen.measureText(said).width / 2;
      pen.fillText(said, Math.min(x(mark), width - half), height - 9);
    }
    lines.forEach(({ values }, k) => {
      pen.strokeStyle = hex(colourOf(k));
      pen.lineWidth = 1.8;
      pen.lineJoin = "round";
      pen.beginPath();
      let on = false;
      values.forEach((value, frame) => {
        if (!Number.isFinite(value)) return void (on = false);
        const goesOn = on && !wraps(unit, values[frame - 1], value);
        pen[goesOn ? "lineTo" : "moveTo"](x(times[frame]), y(value));
        on = true;
      });
      pen.stroke();
    });
    pen.strokeStyle = css("--text");
    pen.globalAlpha = 0.55;
    pen.beginPath();
    pen.moveTo(x(time), top);
    pen.lineTo(x(time), bottom);
    pen.stroke();
    pen.globalAlpha = 1;
  }

  return (time) => {
    const { low, next, part } = frameAt(time);
    for (const chart of drawn) {
      draw(chart, time);
      chart.lines.forEach(({ values }, k) => {
        const between = values[low] + (part ? part * (values[next] - values[low]) : 0);
        const value = wraps(chart.unit, values[low], values[next]) ? values[part < 0.5 ? low : next] : between;
        chart.values[k].textContent = digits(value);
      });
    }
  };
}
