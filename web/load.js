// For tests: what three.js makes of a mesh file. load(FORMAT, BASE64) resolves to the meshes that it drew once.

import {Box3, LoadingManager, Mesh, PerspectiveCamera, Scene, WebGLRenderer} from 'three';
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';
import {ThreeMFLoader} from 'three/addons/loaders/3MFLoader.js';

// Resolves once the pictures are there, too: 3MFLoader returns before they are.
function parsed(format, data) {
  return new Promise((resolve, reject) => {
    const manager = new LoadingManager();
    let scene = null, pending = false;
    const end = () => { if (scene && !pending) resolve(scene); };
    manager.onStart = () => { pending = true; };
    manager.onLoad = () => { pending = false; end(); };
    manager.onError = (url) => reject(new Error(`${url} could not be loaded`));
    if (format === 'glb') {
      new GLTFLoader(manager).parse(data, '', (gltf) => { scene = gltf.scene; end(); }, reject);
    } else {
      scene = new ThreeMFLoader(manager).parse(data);
      end();
    }
  });
}

window.load = async (format, base64) => {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const scene = new Scene();
  scene.add(await parsed(format, bytes.buffer));
  const meshes = [];
  scene.traverse((node) => {
    if (!(node instanceof Mesh)) return;
    const {geometry, material} = node;
    const places = geometry.index ?? geometry.attributes.position;
    meshes.push({
      triangles: places.count / 3, colours: 'color' in geometry.attributes, uv: 'uv' in geometry.attributes,
      picture: material.map ? [material.map.image.width, material.map.image.height, material.map.colorSpace] : null
    });
  });
  const {min, max} = new Box3().setFromObject(scene);
  const camera = new PerspectiveCamera();
  camera.position.set(max.x, max.y, max.z + (max.z - min.z));
  new WebGLRenderer().render(scene, camera);
  return meshes;
};
