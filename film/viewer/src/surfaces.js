// Meshes of bodies.

import * as THREE from "three";
import { toCreasedNormals } from "three/addons/utils/BufferGeometryUtils.js";
import { shorts } from "./data.js";

/** Faces that meet at less than this are one surface (rad). */
const CREASE = 0.6;

/** A mesh: its corners are parts of its box, in steps of 1/65535. */
export function surface({ low, high, corners, faces, colour }, own, name) {
  const steps = shorts(corners);
  const places = new Float32Array(steps.length);
  for (let k = 0; k < steps.length; k++) places[k] = low[k % 3] + (steps[k] / 65535) * (high[k % 3] - low[k % 3]);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(places, 3));
  geometry.setIndex(new THREE.BufferAttribute(shorts(faces), 1));
  const material = colour
    ? new THREE.MeshStandardMaterial({ color: colour, metalness: 0.15, roughness: 0.55, side: THREE.DoubleSide })
    : own;
  const made = new THREE.Mesh(toCreasedNormals(geometry, CREASE), material);
  made.castShadow = made.receiveShadow = true;
  made.userData.name = name;
  return made;
}
