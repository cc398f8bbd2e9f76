// The page of `turnscan serve`: one action at a time, for a person beside the turntable.

import {Group, Mesh, MeshStandardMaterial} from 'three';
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';
import {ModelView, addKeys} from './model_view.js';
import {MeshoptDecoder, unpack} from './packed_model.js';
import {LANGUAGES, textsOf} from './serve_texts.js';

const API = '/api/v1/';
const RENEW_MS = 10000;  // the lease is kept for 30 s
const SURFACE_MS = 1000;  // it is made while somebody asks every 5 s
const CLAY = 0xccc4b8;  // of what has no colours
const MESHES = {'mesh.3mf': '3MF', 'mesh.stl': 'STL', 'mesh.glb': 'GLB', 'mesh.ply': 'PLY'};
const $ = (id) => document.getElementById(id);

let text = textsOf('en');
let key = stored('sessionStorage', 'operator') ?? '';
let operates = false;  // this page
let state = {job: null, operator: false};
let devices = [];
let dismissed = null;  // the job whose end was seen
let shown = null;      // the scan in the result card, as "id state"
let shownStep = '';
let view = null;
let growing = null;       // the view of the surface that grows
let grown = {number: 0};  // the surface in it, and of which job

function stored(kind, name, value) {
  try {
    if (value !== undefined) window[kind].setItem(name, value);
    return window[kind].getItem(name);
  } catch {
    return value;  // a browser that keeps nothing
  }
}

async function ask(method, path, body) {
  const headers = {'Turnscan-Operator': key};
  if (body) headers['Content-Type'] = 'application/json';
  const response = await fetch(API + path, {method, headers, body: body && JSON.stringify(body)});
  const answer = await response.json().catch(() => ({}));
  if (!response.ok) throw Object.assign(new Error(answer.error?.message ?? response.statusText), {status: response.status});
  return answer;
}

// A refusal is said where the person looks.
async function act(method, path, body) {
  try {
    trouble('');
    return await ask(method, path, body);
  } catch (error) {
    trouble(error.status ? error.message : text('lost'));
    return null;
  }
}

function trouble(message) {
  $('trouble').textContent = message;
  $('trouble').hidden = !message;
}

async function operate() {
  try {
    key = (await ask('POST', 'operator')).key;
    stored('sessionStorage', 'operator', key);
    operates = true;
  } catch (error) {
    if (error.status === 409) operates = false;
  }
  draw();
}

function element(name, attributes = {}, content = '') {
  const made = document.createElement(name);
  for (const [attribute, value] of Object.entries(attributes)) made.setAttribute(attribute, value);
  made.textContent = content;
  return made;
}

function button(label, action, main = false) {
  const made = element('button', {type: 'button', class: main ? 'main' : ''}, label);
  made.addEventListener('click', async () => {
    made.disabled = true;
    await action();
    made.disabled = false;
  });
  return made;
}

async function start() {
  const started = await act('POST', 'scans', {device: $('device').value});
  if (!started) return;
  dismissed = null;
  showResult(null);
}

// What there is to say and to press now.
function step() {
  const {job} = state;
  const cancel = [text('cancel'), () => act('POST', 'job/cancel')];
  if (job?.state === 'asking') {
    const say = (another) => () => act('POST', 'job/answer', {another_side: another});
    return {title: 'askTitle', say: job.question.advice, advice: true,
            buttons: [[text('done'), say(false), true], [text('turned'), say(true), true], cancel]};
  }
  if (job?.state === 'running') {
    const left = job.seconds_left > 0 ? ' ' + text('left', job.seconds_left) : '';
    if (job.kind === 'reconstruct' || (job.frames > 0 && !job.phase.startsWith('record')))
      return {title: 'computeTitle', say: text('compute'), aside: left, buttons: [cancel]};
    if (job.phase.startsWith('wait')) return {title: 'waitTitle', say: text('wait'), buttons: [cancel]};
    if (job.phase.startsWith('record'))
      return {title: 'recordTitle', say: text('record', job.frames), aside: left, buttons: [cancel]};
    return {title: 'prepareTitle', say: text('prepare'), buttons: [cancel]};
  }
  if (job && dismissed !== job.id + job.kind + job.state) {
    const go = () => { dismissed = job.id + job.kind + job.state; draw(); $('title').focus(); };
    if (job.state === 'done')
      return job.kind === 'record'
        ? {title: 'recordedTitle', say: text('recordedText'), buttons: [[text('another'), go, true]]}
        : {title: 'doneTitle', say: [text('doneText'), ...job.notes, job.error ?? ''].join(' '), buttons: [[text('another'), go, true]]};
    return {title: job.state === 'failed' ? 'failedTitle' : 'cancelledTitle',
            say: job.frames > 0 ? text('failed') : '',
            error: job.error, buttons: [[text('again'), go, true]]};
  }
  return {title: 'placeTitle', say: text('place'), choice: true,
          buttons: devices.length ? [[text('start'), start, true]] : []};
}

function draw() {
  const {job} = state;
  const now = step();
  // Numbers that count must not be read out at each change.
  $('say').setAttribute('aria-live', now.title === 'recordTitle' ? 'off' : 'polite');
  set($('say'), now.say + (now.aside ?? ''));
  $('say').classList.toggle('soft', !!now.advice);
  const viewer = !operates;
  const title = viewer && !job ? text(state.operator ? 'viewerTitle' : 'placeTitle') : text(now.title);
  set($('title'), title);
  document.title = title + ' - turnscan';
  $('device-choice').hidden = viewer || !now.choice || devices.length < 2;
  $('progress').hidden = job?.state !== 'running';
  if (job?.fraction == null) $('progress').removeAttribute('value');
  else $('progress').value = job.fraction;
  drawSurface();
  show($('live'), job?.picture ? `${API}picture.jpg?${job.picture}` : '', text('live'));
  show($('advice'), now.advice ? `${API}scans/${job.id}/files/advice.png?${job.question.pass}` : '', text('advice'));
  if (now.error) trouble(now.error);
  // Rebuilt only when it says something else, so that the focus stays.
  const id = [title, viewer, state.operator, job?.id, now.buttons.length, document.documentElement.lang].join();
  if (id !== shownStep) {
    shownStep = id;
    const had = $('buttons').contains(document.activeElement);
    if (!now.error) trouble('');
    const made = !viewer ? now.buttons.map((b) => button(...b))
      : state.operator ? [] : [button(text('take'), operate, true)];
    $('buttons').replaceChildren(...made);
    if (viewer && state.operator && job) $('buttons').append(element('p', {class: 'soft'}, text('viewerTitle')));
    if (had) (made[0] ?? $('title')).focus();
  }
}

function set(place, content) {
  if (place.textContent !== content) place.textContent = content;
}

function show(image, source, alt) {
  image.alt = alt;
  if (!source) image.hidden = true;
  else if (image.dataset.source !== source) {
    image.dataset.source = source;
    image.onload = () => { image.hidden = false; };
    image.onerror = () => { image.hidden = true; };
    image.src = source;
  } else if (image.complete && image.naturalWidth) image.hidden = false;
}

// From the first frames until the mesh is there.
const surfaceIsOf = (job) => job?.state === 'running' && job.kind !== 'reconstruct' && job.frames > 0;

function drawSurface() {
  const is = grown.number > 0 && grown.job === state.job?.id && surfaceIsOf(state.job);
  $('surface').hidden = !is;
  $('surface').setAttribute('aria-label', text('surface'));
  $('watch').hidden = !is && !state.job?.picture;
}

function takeSurface(next) {
  const material = new MeshStandardMaterial({color: CLAY, roughness: 0.85});
  const group = new Group().add(...next.model.objects.map((o) => new Mesh(unpack(o, []).geometry, material)));
  if (growing) growing.replace(group);
  else addKeys(growing = new ModelView($('surface'), group), $('surface'));
  $('surface').dataset.frames = next.frames;
}

// Only for a page that is looked at.
async function askForSurface() {
  const {job} = state;
  const complete = grown.job === job?.id && !job?.phase.startsWith('record');
  if (document.hidden || !surfaceIsOf(job) || complete) return;
  const next = await ask('GET', `surface?have=${grown.job === job.id ? grown.number : 0}`).catch(() => null);
  if (!next || state.job?.id !== job.id) return;
  grown = {job: job.id, number: next.number};
  drawSurface();
  if (next.model) takeSurface(next);
}

async function watchSurface() {
  try {
    for (await MeshoptDecoder.ready; ; await new Promise((go) => setTimeout(go, SURFACE_MS))) await askForSurface();
  } catch {  // without WebAssembly or WebGL there is the picture alone
    grown = {number: 0};
    drawSurface();
  }
}

async function showResult(id) {
  shown = id;
  if (!id) { $('result').hidden = true; return; }
  const scan = await ask('GET', `scans/${id}`).catch(() => null);
  if (!scan || shown !== id) return;
  const names = scan.files.map((f) => f.name);
  const verdict = names.includes('report.json')
    ? await ask('GET', `scans/${id}/verdict`).catch(() => ({objects: []})) : {objects: []};
  if (shown !== id) return;
  $('result').hidden = false;
  const first = verdict.objects.map((o) => o.verdict).filter(Boolean);
  const worst = ['red', 'amber', 'green'].find((c) => first.some((v) => v.colour === c));
  $('badge').className = worst ?? '';
  set($('badge'), worst ? text(worst) : scan.error ?? '');
  $('badge').hidden = !$('badge').textContent;
  const order = ['bad', 'fair', 'good'];
  const sentences = first.flatMap((v) => v.sentences);
  sentences.sort((a, b) => order.indexOf(a.level) - order.indexOf(b.level));
  document.querySelector('[data-text=reasons]').hidden = !sentences.length;
  $('verdict').replaceChildren(...sentences.map((sentence) => {
    const item = element('li', {class: sentence.level, lang: 'en'}, sentence.text);
    item.prepend(element('span', {class: 'hidden'}, text(sentence.level) + ': '));
    return item;
  }));
  const link = (name, label, more) => {
    const bytes = scan.files.find((f) => f.name === name).bytes;
    const made = element('a', {class: 'button', href: `${API}scans/${id}/files/${name}`, ...more}, label);
    made.append(element('span', {class: 'soft'}, `${(bytes / 1e6).toFixed(1)} MB`));
    const item = element('li');
    item.append(made);
    return item;
  };
  const meshes = [...Object.keys(MESHES).filter((n) => names.includes(n)),
                  ...names.filter((n) => n.startsWith('mesh-'))];
  $('files').replaceChildren(...meshes.map((n) => link(n, MESHES[n] ?? n.slice(5), {download: ''})));
  if (names.includes('report.html'))
    $('files').append(link('report.html', text('open'), {target: '_blank', rel: 'noopener'}));
  document.querySelector('[data-text=files]').hidden = !$('files').children.length;
  $('result-buttons').replaceChildren();
  const add = (label, action) => operates && $('result-buttons').append(button(label, action));
  if (scan.state === 'unfinished') {
    $('result-buttons').append(element('p', {}, text('unfinishedText')));
    add(text('resume'), () => act('POST', `scans/${id}/resume`));
  }
  if (!names.includes('mesh.glb') && ['unfinished', 'recorded'].includes(scan.state))
    add(text('reconstruct'), () => { dismissed = null; act('POST', `scans/${id}/reconstruct`); });
  if (scan.state !== 'running') add(text('delete'), () => askToDelete(id));
  await showModel(names.includes('mesh.glb') ? `${API}scans/${id}/files/mesh.glb` : '');
}

// A second press, on a button that says what it does, since it cannot be taken back.
function askToDelete(id) {
  const keep = button(text('keep'), () => showResult(id));
  const gone = button(text('deleteIt'), async () => {
    if (!(await act('DELETE', `scans/${id}`))) return;
    showResult(null);
    await listScans();
    $('title').focus();
  });
  $('result-buttons').replaceChildren(element('p', {role: 'alert'}, text('deleteText')), keep, gone);
  keep.focus();
}

async function showModel(source) {
  view?.renderer.dispose();
  view = null;
  const canvas = element('canvas', {id: 'model', tabindex: '0', role: 'img', 'aria-label': text('model')});
  $('model').replaceWith(canvas);
  canvas.hidden = !source;
  $('model-help').hidden = !source;
  set($('model-help'), text('modelHelp'));
  if (!source) return;
  try {
    const {scene} = await new GLTFLoader().loadAsync(source);
    scene.traverse((node) => {
      if (!node.isMesh) return;
      const {map} = node.material;
      node.material = new MeshStandardMaterial({map, roughness: 0.85,
                                                vertexColors: !map && 'color' in node.geometry.attributes,
                                                color: map || 'color' in node.geometry.attributes ? 0xffffff : CLAY});
    });
    scene.scale.setScalar(1000);  // metres to millimetres
    if ($('model') !== canvas) return;
    view = new ModelView(canvas, new Group().add(scene));
    addKeys(view, canvas);
  } catch {
    canvas.hidden = true;
    set($('model-help'), text('noModel'));
  }
}

async function listScans() {
  const {scans} = await ask('GET', 'scans').catch(() => ({scans: []}));
  $('scans').hidden = !scans.length;
  $('scan-list').replaceChildren(...scans.map((scan) => {
    const [day, time] = scan.id.split('-');
    const name = !time ? scan.id : `${day.slice(0, 4)}-${day.slice(4, 6)}-${day.slice(6)} ${time?.slice(0, 2)}:${time?.slice(2, 4)}`;
    const made = button(name, async () => { await showResult(scan.id); $('result').scrollIntoView(); });
    made.append(element('span', {class: 'soft'}, text(scan.state === 'done' ? 'done_' : scan.state)));
    const item = element('li');
    item.append(made);
    return item;
  }));
}

function take(next) {
  const before = state.job, {job} = next;
  state = next;
  draw();
  const key_ = (j) => j && `${j.id} ${j.state} ${j.question?.pass}`;
  if (key_(before) === key_(job)) return;
  const ended = job && ['done', 'failed', 'cancelled'].includes(job.state);
  if (ended) listScans();
  if (job && (job.state === 'done' || job.state === 'asking')) showResult(job.id);
}

function speak(language) {
  text = textsOf(language);
  document.documentElement.lang = language;
  stored('localStorage', 'language', language);
  $('language').value = language;
  for (const node of document.querySelectorAll('[data-text]')) set(node, text(node.dataset.text));
  draw();
  listScans();
  if (shown) showResult(shown);
}

let lost = false;

function watch() {
  const events = new EventSource(API + 'events');
  events.addEventListener('state', (event) => {
    if (lost) trouble('');
    lost = false;
    take(JSON.parse(event.data));
  });
  // It tries again by itself, unless it was refused.
  events.onerror = async () => {
    lost = true;
    trouble(text('lost'));
    if (events.readyState !== EventSource.CLOSED) return;
    setTimeout(watch, 3000);
    await ask('GET', 'state').catch((error) => { if (error.status) trouble(error.message); });
  };
}

async function begin() {
  for (const [code, name] of Object.entries(LANGUAGES)) $('language').append(new Option(name, code));
  $('language').addEventListener('change', () => speak($('language').value));
  const wished = [stored('localStorage', 'language'), ...navigator.languages.map((l) => l.slice(0, 2)), 'en'];
  // Whoever was here before goes on, and the first who comes operates.
  state.operator = (await ask('GET', 'state').catch(() => state)).operator;
  if (key || !state.operator) await operate();
  speak(wished.find((l) => l in LANGUAGES));
  watch();
  watchSurface();
  setInterval(() => { if (operates) operate(); }, RENEW_MS);
  document.addEventListener('visibilitychange', () => { if (!document.hidden && operates) operate(); });
  devices = (await ask('GET', 'devices').catch(() => ({devices: []}))).devices;
  // Where there are sensors nobody looks for the simulated ones.
  const real = devices.filter((d) => d.kind !== 'virtual');
  devices = real.length ? real : devices;
  for (const device of devices) $('device').append(new Option(device.model, device.uri));
  draw();
}

begin();
