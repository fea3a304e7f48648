// The sliders of a page in which the mechanism runs.

import { digits } from "./charts.js";

const id = (name) => document.getElementById(name);
const made = (tag, className, text = "") => {
  const element = document.createElement(tag);
  element.className = className;
  element.textContent = text;
  return element;
};

/** Steps of a slider from end to end. */
const STEPS = 400;

/** Shows the sliders of a module. Moves are collected and done by `apply`, once a picture. */
export function panel(module, { refused, restarted }) {
  const first = [...module.values];
  const waiting = new Map();
  const groups = new Map();
  let dragged = null;
  const rows = module.sliders.map((slider, place) => {
    if (!groups.has(slider.group)) {
      const group = made("section", "group");
      group.append(made("h2", "", slider.group));
      groups.set(slider.group, group);
      id("groups").append(group);
    }
    const row = made("label", "slider");
    const name = made("span", "slider-name", slider.name);
    const number = Object.assign(made("input", "slider-number"), { type: "number", step: "any", ariaLabel: slider.name });
    const unit = made("span", "slider-unit", slider.unit);
    const range = Object.assign(made("input", "slider-range"), {
      type: "range", min: slider.low, max: slider.high, step: (slider.high - slider.low) / STEPS, ariaLabel: slider.name });
    row.append(name, number, unit, range);
    row.title = `${slider.name} from ${digits(slider.low)} to ${digits(slider.high)} ${slider.unit}`;
    groups.get(slider.group).append(row);
    range.oninput = () => {
      dragged = range;
      waiting.set(place, +range.value);
    };
    number.onchange = () => Number.isFinite(number.valueAsNumber) && waiting.set(place, number.valueAsNumber);
    // What was refused goes back when the slider is let go.
    range.onchange = () => requestAnimationFrame(() => show((dragged = null)));
    return { range, number };
  });

  /** Shows the values that hold; of a slider that is in hand, `dragged`, the number alone. */
  function show(dragged = null) {
    rows.forEach(({ range, number }, place) => {
      const value = module.values[place];
      if (range !== dragged) range.value = value;
      number.value = +value.toPrecision(4);
    });
  }
  /** Does what the reader asked for since the last picture. */
  function apply() {
    for (const [place, value] of waiting) {
      try {
        module.set(place, value);
        refused(null);
        if (module.sliders[place].group === "Start") restarted();
      } catch (error) {
        refused(error.message);
      }
    }
    if (waiting.size) show(dragged);
    waiting.clear();
  }
  function restart() {
    try {
      module.restart();
      refused(null);
      restarted();
    } catch (error) {
      refused(error.message);
    }
    show();
  }
  id("restart").onclick = restart;
  id("reset").onclick = () => {
    first.forEach((value, place) => {
      if (module.values[place] !== value) waiting.set(place, value);
    });
    apply();
    restart();
  };
  id("reset").hidden = rows.length === 0;
  show();
  id("sliders").hidden = false;
  document.body.classList.add("live");
  return { apply, show };
}
