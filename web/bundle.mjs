// node bundle.mjs OUT [SCRIPT]: writes the viewer, or another script of this folder, and the licences of what is in it
// as one classic script. An OUT that ends in .html is the page SCRIPT.html with its script and SCRIPT.css in it.

import {readFileSync, writeFileSync} from 'node:fs';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';
import {build} from 'esbuild';

const here = dirname(fileURLToPath(import.meta.url));
const three = JSON.parse(readFileSync(join(here, 'node_modules/three/package.json'), 'utf8'));
const licence = readFileSync(join(here, 'node_modules/three/LICENSE'), 'utf8').trim();
const banner = `/*! three.js ${three.version}\n${licence}\n*/
/*! meshopt_decoder, part of meshoptimizer. Copyright (C) 2016-2026, by Arseny Kapoulkine.
MIT licence, whose text is the same as that of three.js above. */`;

const [out, name = 'viewer.js'] = process.argv.slice(2);
const is_page = out.endsWith('.html');
const bundled = async (file) => (await build({
  entryPoints: [join(here, file)],
  outfile: out,
  write: !is_page,
  bundle: true,
  minify: true,
  format: 'iife',
  target: ['chrome100', 'firefox100', 'safari15.4'],
  legalComments: 'none',
  banner: {js: banner},
  logLevel: 'warning'
})).outputFiles?.[0].text.replaceAll('</script', '<\\/script');

if (is_page) {
  const parts = {style: await bundled(`${name}.css`), script: await bundled(`${name}.js`)};
  const page = readFileSync(join(here, `${name}.html`), 'utf8');
  writeFileSync(out, page.replace(/<(style|script)><\/\1>/g, (_, tag) => `<${tag}>${parts[tag]}</${tag}>`));
} else {
  await bundled(name);
}
