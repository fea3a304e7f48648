// The axes of the ground in a corner of the picture: x red, y green, z blue.

import * as THREE from "three";
import { frame } from "./shapes.js";

function letter(text, colour) {
  const paper = document.createElement("canvas");
  paper.width = paper.height = 64;
  const pen = paper.getContext("2d");
  Object.assign(pen, { font: "600 46px system-ui, sans-serif", textAlign: "center", textBaseline: "middle", fillStyle: colour });
  pen.fillText(text, 32, 34);
  const map = new THREE.CanvasTexture(paper);
  map.colorSpace = THREE.SRGBColorSpace;
  const made = new THREE.Sprite(new THREE.SpriteMaterial({ map, depthTest: false, transparent: true }));
  made.scale.setScalar(0.5);
  return made;
}

/** Draws the triad over the picture of a camera, where a place of the page is. */
export function triad(place, canvas, renderer) {
  const scene = new THREE.Scene();
  scene.add(frame(1, "ground"));
  ["#e0453a", "#2fa84f", "#3b6fe0"].forEach((colour, k) => {
    const name = letter("xyz"[k], colour);
    name.position.setComponent(k, 1.24);
    scene.add(name);
  });
  const own = new THREE.OrthographicCamera(-1.5, 1.5, 1.5, -1.5, -10, 10);
  return (camera) => {
    const [box, all] = [place.getBoundingClientRect(), canvas.getBoundingClientRect()];
    if (!box.width) return;
    own.quaternion.copy(camera.quaternion);
    renderer.autoClear = false;
    renderer.clearDepth();
    renderer.setViewport(box.left - all.left, all.bottom - box.bottom, box.width, box.height);
    renderer.render(scene, own);
    renderer.setViewport(0, 0, canvas.clientWidth, canvas.clientHeight);
    renderer.autoClear = true;
  };
}
