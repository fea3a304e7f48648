// Signs on buttons, drawn here: not every font has them.

const PATHS = {
  play: "M4 2l10 6-10 6z",
  pause: "M3.5 2h3v12h-3zM9.5 2h3v12h-3z",
  loop: "M8 2.6A5.4 5.4 0 1 0 13.4 8h-1.8A3.6 3.6 0 1 1 8 4.4V7l4.2-3.5L8 0z",
  theme: "M8 1a7 7 0 1 0 0 14A7 7 0 1 0 8 1zM8 2.6v10.8A5.4 5.4 0 0 1 8 2.6z",
  list: "M2 3h12v1.6H2zM2 7.2h12v1.6H2zM2 11.4h12V13H2z",
};

export const icon = (name) => `<svg viewBox="0 0 16 16" aria-hidden="true"><path fill-rule="evenodd" d="${PATHS[name]}"/></svg>`;
