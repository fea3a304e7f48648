// What a film holds: read from the page, with the numbers of all frames in flat arrays.

export const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
const floats = (text) => new Float32Array(bytes(text));
export const shorts = (text) => new Uint16Array(bytes(text));

export const film = JSON.parse(document.getElementById("film").textContent);

film.poses = floats(film.poses);
film.loads = floats(film.loads);
for (const reading of film.readings) reading.values = floats(reading.values);
if (film.ghost) film.ghost.poses = floats(film.ghost.poses);

/** Numbers of a body in a frame: position, then Euler parameters with the scalar first. */
export const POSE = 7;
/** Numbers of an arrow in a frame: point, then force. */
export const LOAD = 6;

/** The frame before a time, and how far the time is on to the next. */
export function frameAt(time, times = film.times) {
  let [low, high] = [0, times.length - 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  const next = Math.min(low + 1, times.length - 1);
  const step = times[next] - times[low];
  return { low, next, part: step > 0 ? Math.min(1, Math.max(0, (time - times[low]) / step)) : 0 };
}

/** Points of joints and forces on a body (`null` is the ground), and what is traced: a plate is
 * drawn between these. */
export const spanning = (body) => [
  ...film.markers.filter((m) => m.body === body && m.kind === "point"),
  ...film.traces.filter((trace) => trace.body === body),
];

/** All points of a body, named ones too. */
export const points = (body) => [...spanning(body), ...film.points.filter((point) => point.body === body)];

/** The markers of an element by the place of its body. */
export const markersOf = (element, place) =>
  film.markers.filter((m) => m.element === element && m.place === place);
