// The floor: a grid in round units that fades with the distance, and takes the shadow.

import * as THREE from "three";

/** Where the grid begins to fade, over where it ends. */
const CLEAR = 0.3;

/** A floor about the origin, across y, for what is as large as `radius`. */
export function floor(radius) {
  const unit = 10 ** Math.floor(Math.log10(radius));
  const cell = radius / unit < 2 ? unit / 5 : radius / unit < 5 ? unit / 2 : unit;
  const cells = Math.ceil((3.2 * radius) / cell);
  const [places, colours] = [[], []];
  const corner = (x, z) => {
    const far = Math.hypot(x, z) / cells;
    const clear = Math.min(1, Math.max(0, (1 - far) / (1 - CLEAR)));
    places.push(x * cell, 0, z * cell);
    colours.push(1, 1, 1, clear * clear);
  };
  // In pieces of a cell, so that each line fades along its way.
  for (let line = -cells; line <= cells; line++)
    for (let step = -cells; step < cells; step++) {
      if (Math.hypot(line, step + 0.5) > cells) continue;
      corner(line, step);
      corner(line, step + 1);
      corner(step, line);
      corner(step + 1, line);
    }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(places, 3));
  geometry.setAttribute("color", new THREE.Float32BufferAttribute(colours, 4));
  const lines = new THREE.LineBasicMaterial({ vertexColors: true, transparent: true, depthWrite: false });
  const grid = new THREE.LineSegments(geometry, lines);
  const plane = new THREE.PlaneGeometry(2 * cells * cell, 2 * cells * cell).rotateX(-Math.PI / 2);
  const shade = new THREE.Mesh(plane, new THREE.ShadowMaterial({ opacity: 0.18 }));
  shade.receiveShadow = true;
  const group = new THREE.Group();
  group.add(grid, shade);
  return { group, grid, shade };
}
