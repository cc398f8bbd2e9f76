// The 3D view of a report page. The page holds the model as JSON (#model-data, made by
// src/turnscan/workflow/page) and works without this script: then pictures stand in its place.

import {Color, Group, Mesh, MeshStandardMaterial} from 'three';
import {colorOf, gradient} from './colors.js';
import {ModelView, ZOOM_STEP, addKeys} from './model_view.js';
import {MeshoptDecoder, unpack} from './packed_model.js';

const VIEWS = {  // azimuth from +Z towards +X and elevation, in degrees
  Front: [0, 0], Right: [90, 0], Back: [180, 0], Left: [-90, 0], Top: [0, 89.9], Bottom: [0, -89.9]
};
const FEW_TRIANGLES = 2000;  // of a drawn object, not of a scan: its edges are sharp

function paint(part, field) {
  const colors = part.geometry.getAttribute('color');
  const color = new Color();
  const values = field ? part.values[field.id] : undefined;
  for (let v = 0; v < colors.count; ++v) {
    if (values) color.setRGB(...colorOf(field, values[v]), 'srgb');
    else if (part.surface && !field)
      color.setRGB(part.surface[3 * v] / 255, part.surface[3 * v + 1] / 255,
                   part.surface[3 * v + 2] / 255, 'srgb');
    else color.setRGB(0.8, 0.77, 0.72, 'srgb');
    colors.setXYZ(v, color.r, color.g, color.b);
  }
  colors.needsUpdate = true;
}

class Viewer extends ModelView {
  constructor(canvas, data) {
    const parts = data.objects.map((object) => {
      const part = unpack(object, data.fields);
      part.mesh = new Mesh(part.geometry,
                           new MeshStandardMaterial({
                             vertexColors: true, roughness: 0.85,
                             flatShading: object.triangles < FEW_TRIANGLES
                           }));
      return part;
    });
    super(canvas, new Group().add(...parts.map((part) => part.mesh)));
    this.fields = data.fields;
    this.parts = parts;
    this.setMode('colour');
  }

  setMode(id) {
    this.mode = id;
    const field = this.fields.find((f) => f.id === id);
    for (const part of this.parts) paint(part, field);
    this.canvas.dataset.mode = id;
    this.draw();
  }

  show(index, visible) {
    this.parts[index].mesh.visible = visible;
    this.draw();
  }
}

function element(name, attributes = {}, text = '') {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.textContent = text;
  return made;
}

function addModes(viewer, data, place, legend) {
  const modes = [{id: 'colour', label: data.has_colour ? 'Colour' : 'Shape'}, ...data.fields];
  const group = element('fieldset');
  group.append(element('legend', {}, 'Show'));
  for (const mode of modes) {
    const label = element('label');
    const input = element('input', {type: 'radio', name: 'mode', value: mode.id});
    input.checked = mode.id === 'colour';
    input.addEventListener('change', () => {
      viewer.setMode(mode.id);
      showLegend(legend, data.fields.find((f) => f.id === mode.id));
    });
    label.append(input, ' ' + mode.label);
    group.append(label);
  }
  place.append(group);
}

function showLegend(place, field) {
  place.replaceChildren();
  place.hidden = !field;
  if (!field) return;
  place.append(element('span', {class: 'legend-text'}, field.help));
  if (field.classes) {
    for (const [i, text] of field.classes.entries()) {
      const item = element('span', {class: 'legend-item'});
      const patch = element('span', {class: 'patch'});
      patch.style.backgroundColor = gradient(field, [i / Math.max(field.classes.length - 1, 1)])[0];
      item.append(patch, text);
      place.append(item);
    }
    return;
  }
  const bar = element('span', {class: 'bar'});
  const steps = Array.from({length: 17}, (_, i) => i / 16);
  bar.style.backgroundImage = `linear-gradient(to right, ${gradient(field, steps).join(', ')})`;
  const number = (value) => Number(value.toPrecision(3)).toString();
  place.append(element('span', {}, `${number(field.from)} ${field.unit}`), bar,
               element('span', {}, `${number(field.to)} ${field.unit}`));
}

function addViews(viewer, place) {
  const group = element('div', {role: 'group', 'aria-label': 'View'});
  for (const [name, [azimuth, elevation]] of Object.entries(VIEWS)) {
    const button = element('button', {type: 'button'}, name);
    button.addEventListener('click', () => viewer.look(azimuth, elevation));
    group.append(button);
  }
  for (const [name, sign, factor] of [['Zoom in', '+', ZOOM_STEP],
                                      ['Zoom out', '\u2212', 1 / ZOOM_STEP]]) {
    const button = element('button', {type: 'button', 'aria-label': name, title: name}, sign);
    button.addEventListener('click', () => viewer.zoom(factor));
    group.append(button);
  }
  place.append(group);
}

function addObjects(viewer, data, place) {
  if (data.objects.length < 2) return;
  const group = element('fieldset');
  group.append(element('legend', {}, 'Objects'));
  data.objects.forEach((object, index) => {
    const label = element('label');
    const input = element('input', {type: 'checkbox'});
    input.checked = true;
    input.addEventListener('change', () => viewer.show(index, input.checked));
    label.append(input, ' ' + object.name);
    group.append(label);
  });
  place.append(group);
}

async function start() {
  const section = document.getElementById('view');
  const canvas = document.getElementById('model');
  const status = document.getElementById('view-status');
  try {
    const data = JSON.parse(document.getElementById('model-data').textContent);
    await MeshoptDecoder.ready;
    section.hidden = false;
    const viewer = new Viewer(canvas, data);
    const legend = document.getElementById('legend');
    const switches = document.getElementById('switches');
    addModes(viewer, data, switches, legend);
    addObjects(viewer, data, switches);
    addViews(viewer, switches);
    addKeys(viewer, canvas);
    status.textContent = '';
  } catch (error) {
    canvas.hidden = true;
    section.hidden = false;
    status.textContent = 'This browser cannot draw the model in 3D (' + error.message +
      '); the pictures below show it from six sides.';
  }
}

start();
