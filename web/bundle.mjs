// node bundle.mjs OUT [SCRIPT]: writes the viewer, or another script of this folder, and the licences of what is in it
// as one classic script.

import {readFileSync} from 'node:fs';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';
import {build} from 'esbuild';

const here = dirname(fileURLToPath(import.meta.url));
const three = JSON.parse(readFileSync(join(here, 'node_modules/three/package.json'), 'utf8'));
const licence = readFileSync(join(here, 'node_modules/three/LICENSE'), 'utf8').trim();
const banner = `/*! three.js ${three.version}\n${licence}\n*/
/*! meshopt_decoder, part of meshoptimizer. Copyright (C) 2016-2026, by Arseny Kapoulkine.
MIT licence, whose text is the same as that of three.js above. */`;

await build({
  entryPoints: [join(here, process.argv[3] ?? 'viewer.js')],
  outfile: process.argv[2],
  bundle: true,
  minify: true,
  format: 'iife',
  target: ['chrome100', 'firefox100', 'safari15.4'],
  legalComments: 'none',
  banner: {js: banner},
  logLevel: 'warning'
});
