// Cameras: views that fit, and a body that they follow.

import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

/** A direction within this of what is up is from above (cosine). */
const ABOVE = 0.9999;

/** The cameras of a stage, and what moves them. `resized` is called where the picture has another size. */
export function views(canvas, renderer, { set, middle, radius, side, right }, resized) {
  const cameras = {
    perspective: new THREE.PerspectiveCamera(32, 1, 0.01 * radius, 60 * radius),
    orthographic: new THREE.OrthographicCamera(-1, 1, 1, -1, -40 * radius, 40 * radius),
  };
  let camera = cameras.perspective;
  let reach = radius;
  /** The direction of a view that nobody has changed since: it stays fitted when the page changes its size. */
  let fitted = null;
  let controls;
  /** The body that is followed, and where it was. */
  let followed = null;
  const last = new THREE.Vector3();

  function use(next) {
    next.up.copy(set.up);
    next.position.copy(camera.position);
    const target = controls?.target.clone() ?? middle.clone();
    controls?.dispose();
    camera = next;
    controls = new OrbitControls(camera, canvas);
    controls.enableDamping = true;
    controls.dampingFactor = 0.12;
    controls.addEventListener("start", () => (fitted = null));
    controls.target.copy(target);
    resize();
  }
  /** The part of the stage's height, about its middle, that no controls are over. */
  function freeHeight() {
    const box = canvas.getBoundingClientRect();
    const above = document.querySelector(".views").getBoundingClientRect().bottom - box.top;
    const below = box.bottom - document.querySelector(".layers").getBoundingClientRect().top;
    return Math.min(0.9, Math.max(0.5, 1 - (2 * Math.max(above, below)) / box.height));
  }
  /** Looks from a direction, as near as everything that has mass stays in the picture. */
  function fit(direction) {
    const way = (direction ?? camera.position.clone().sub(controls.target)).normalize();
    // From above, what is up in the picture is nearly up: the camera would choose, and not as it is reckoned here.
    if (Math.abs(way.dot(set.up)) > ABOVE) way.addScaledVector(right, 1e-3).normalize();
    const aspect = canvas.clientWidth / canvas.clientHeight;
    const half = Math.tan((cameras.perspective.fov * Math.PI) / 360);
    // Axes of the picture, and what is free of controls: less at the sides than above and below.
    const across = set.up.clone().cross(way).normalize();
    const upward = way.clone().cross(across);
    const bounds = (axis) => {
      const far = set.places.map((place) => place.dot(axis));
      return [Math.min(...far), Math.max(...far)];
    };
    const [x, y] = [bounds(across), bounds(upward)];
    const centre = across.clone().multiplyScalar((x[0] + x[1]) / 2)
      .addScaledVector(upward, (y[0] + y[1]) / 2).addScaledVector(way, middle.dot(way));
    let distance = 0;
    const margin = 0.07 * set.size;
    const free = freeHeight();
    for (const place of set.places) {
      const off = place.clone().sub(centre);
      const wide = (Math.abs(off.dot(across)) + margin) / (0.9 * half * aspect);
      const high = (Math.abs(off.dot(upward)) + margin) / (free * half);
      distance = Math.max(distance, Math.max(wide, high) + off.dot(way));
    }
    fitted = way.clone();
    controls.target.copy(centre);
    camera.position.copy(centre).addScaledVector(way, distance);
    reach = distance * half;
    cameras.orthographic.zoom = 1;
    controls.update();
    resize();
  }
  function resize() {
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    renderer.setSize(width, height, false);
    const aspect = width / height;
    cameras.perspective.aspect = aspect;
    const half = reach;
    Object.assign(cameras.orthographic, { left: -half * aspect, right: half * aspect, top: half, bottom: -half });
    for (const each of Object.values(cameras)) each.updateProjectionMatrix();
    resized();
  }
  /** The direction that a page opens with: of a plane mechanism along its normal, right-handed, what is level to the
   * right; of others a corner. */
  function first() {
    const corner = set.up.clone().multiplyScalar(0.55).addScaledVector(side, 0.55).addScaledVector(right, 1);
    if (!set.normal) return corner;
    const level = set.normal.clone().cross(set.up);
    if (level.length() < 0.02) return set.up.clone();
    const largest = level.toArray().reduce((a, b) => (Math.abs(b) > Math.abs(a) + 1e-6 ? b : a));
    if (largest < 0) level.negate();
    return level.cross(set.up);
  }
  use(camera);
  new ResizeObserver(() => (fitted ? fit(fitted.clone()) : resize())).observe(canvas);

  return {
    fit,
    first,
    corner: () => set.up.clone().multiplyScalar(0.55).addScaledVector(side, 0.55).addScaledVector(right, 1),
    get camera() {
      return camera;
    },
    /** Changes between perspective and parallel rays, which is the answer. */
    flatten() {
      use(camera === cameras.perspective ? cameras.orthographic : cameras.perspective);
      return camera === cameras.orthographic;
    },
    /** Goes with a body, an object of the stage; `null` follows none. */
    follow(body) {
      followed = body;
      if (body) last.copy(body.position);
    },
    update() {
      if (followed) {
        const moved = followed.position.clone().sub(last);
        last.copy(followed.position);
        camera.position.add(moved);
        controls.target.add(moved);
      }
      controls.update();
    },
  };
}
