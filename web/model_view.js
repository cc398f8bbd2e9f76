// A model that is looked at: turned, moved and zoomed by mouse, finger and keys.

import {
  Box3, Color, DirectionalLight, HemisphereLight, PerspectiveCamera, Scene, WebGLRenderer
} from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';

const KEY_STEP_DEG = 10;
export const ZOOM_STEP = 1.2;

export class ModelView {
  // group: in millimetres, y up.
  constructor(canvas, group) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({canvas, antialias: true, preserveDrawingBuffer: true});
    this.scene = new Scene();
    this.scene.background = new Color(0xf4f5f6);
    this.camera = new PerspectiveCamera(25, 1, 1, 10000);
    this.scene.add(new HemisphereLight(0xffffff, 0x8a8580, 1.7));
    const key = new DirectionalLight(0xffffff, 1.9);
    key.position.set(-0.6, 0.9, 1.0);
    this.camera.add(key);
    this.scene.add(this.camera);
    this.scene.add(group);
    this.group = group;
    this.frame(group);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.target.copy(this.center);
    this.controls.addEventListener('change', () => this.draw());
    this.look(35, 17);
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
  }

  frame(group) {
    const {min, max} = new Box3().setFromObject(group);
    this.center = min.clone().add(max).multiplyScalar(0.5);
    this.radius = Math.max(max.distanceTo(min) / 2, 1e-3);
    this.camera.near = this.radius / 50;
    this.camera.far = this.radius * 100;
  }

  // Another model in its place, seen from where the first was.
  replace(group) {
    const before = this.distance();
    this.scene.remove(this.group);
    this.group.traverse((node) => node.geometry?.dispose());
    this.scene.add(group);
    this.group = group;
    this.frame(group);
    this.turn(0, 0);
    this.zoom(before / this.distance());
  }

  // All of the model is in the picture, whatever its shape.
  distance() {
    const half = Math.PI * this.camera.fov / 360;
    const narrow = Math.min(half, Math.atan(Math.tan(half) * this.camera.aspect));
    return this.radius / Math.sin(narrow);
  }

  look(azimuthDeg, elevationDeg, distance = this.distance()) {
    const azimuth = azimuthDeg * Math.PI / 180;
    const elevation = elevationDeg * Math.PI / 180;
    this.camera.position.set(Math.sin(azimuth) * Math.cos(elevation), Math.sin(elevation),
                             Math.cos(azimuth) * Math.cos(elevation))
      .multiplyScalar(distance).add(this.center);
    this.controls.target.copy(this.center);
    this.controls.update();
    this.draw();
  }

  turn(azimuthDeg, elevationDeg) {
    const way = this.camera.position.clone().sub(this.controls.target);
    const distance = way.length();
    const azimuth = Math.atan2(way.x, way.z) * 180 / Math.PI + azimuthDeg;
    const elevation = Math.asin(way.y / distance) * 180 / Math.PI + elevationDeg;
    this.look(azimuth, Math.min(89.9, Math.max(-89.9, elevation)), distance);
  }

  zoom(factor) {
    const way = this.camera.position.clone().sub(this.controls.target).divideScalar(factor);
    const distance = Math.min(Math.max(way.length(), this.radius / 20), this.radius * 40);
    this.camera.position.copy(this.controls.target).add(way.setLength(distance));
    this.controls.update();
    this.draw();
  }

  resize() {
    const {clientWidth, clientHeight} = this.canvas;
    if (!clientWidth || !clientHeight) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    this.renderer.setSize(clientWidth, clientHeight, false);
    const before = this.distance();
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    this.zoom(before / this.distance());
  }

  draw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.renderer.render(this.scene, this.camera);
      this.canvas.dataset.state = 'drawn';
      this.canvas.dataset.shown = this.mode ?? '';
    });
  }
}

export function addKeys(viewer, canvas) {
  const keys = {
    ArrowLeft: () => viewer.turn(-KEY_STEP_DEG, 0), ArrowRight: () => viewer.turn(KEY_STEP_DEG, 0),
    ArrowUp: () => viewer.turn(0, KEY_STEP_DEG), ArrowDown: () => viewer.turn(0, -KEY_STEP_DEG),
    '+': () => viewer.zoom(ZOOM_STEP), '=': () => viewer.zoom(ZOOM_STEP),
    '-': () => viewer.zoom(1 / ZOOM_STEP), Home: () => viewer.look(35, 17)
  };
  canvas.addEventListener('keydown', (event) => {
    const action = keys[event.key];
    if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    action();
  });
}
