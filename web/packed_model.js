// Meshes as the program packs them for its pages (model_json() in workflow/page).

import {BufferAttribute, BufferGeometry} from 'three';
import {MeshoptDecoder} from 'three/addons/libs/meshopt_decoder.module.js';

export {MeshoptDecoder};

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

// Once the decoder is ready. Positions in millimetres; `values` of each field as numbers in the field's unit.
export function unpack(object, fields) {
  const stride = object.stride;
  const records = new Uint8Array(object.vertices * stride);
  MeshoptDecoder.decodeVertexBuffer(records, object.vertices, stride,
                                    bytesOf(object.vertex_stream));
  const indices = new Uint8Array(object.triangles * 12);
  MeshoptDecoder.decodeIndexBuffer(indices, object.triangles * 3, 4, bytesOf(object.index_stream));
  const view = new DataView(records.buffer);
  const positions = new Float32Array(object.vertices * 3);
  for (let v = 0; v < object.vertices; ++v) {
    for (let axis = 0; axis < 3; ++axis) {
      const quantised = view.getUint16(v * stride + 2 * axis, true);
      positions[3 * v + axis] = object.origin_mm[axis] + quantised * object.step_mm;
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setAttribute('color', new BufferAttribute(new Float32Array(positions.length), 3));
  geometry.setIndex(new BufferAttribute(new Uint32Array(indices.buffer), 1));
  geometry.computeVertexNormals();
  const values = {};
  for (const field of fields) {
    const offset = object.offsets[field.id];
    if (offset === undefined) continue;
    const array = new Float32Array(object.vertices);
    const step = (field.to - field.from) / 65534;
    for (let v = 0; v < object.vertices; ++v) {
      const quantised = view.getUint16(v * stride + offset, true);
      array[v] = quantised === 65535 ? NaN : field.from + quantised * step;
    }
    values[field.id] = array;
  }
  let surface = null;
  if (object.offsets.colour !== undefined) {
    surface = new Uint8Array(object.vertices * 3);
    for (let v = 0; v < object.vertices; ++v)
      surface.set(records.subarray(v * stride + object.offsets.colour,
                                   v * stride + object.offsets.colour + 3), 3 * v);
  }
  return {geometry, values, surface};
}
