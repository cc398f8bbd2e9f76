// node validate.mjs FILE.glb...: what Khronos' glTF validator says of each file, one line a finding; exit code 1 when
// there is any, hints included. For tests: the validator is a development package of this folder.

import {readFileSync} from 'node:fs';
import validator from 'gltf-validator';

for (const file of process.argv.slice(2)) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), {uri: file, maxIssues: 20});
  const {info, issues} = report;
  console.log(`${file}: ${info.totalTriangleCount} triangles, ${info.resources?.filter((r) => r.image).length ?? 0} images`);
  for (const found of issues.messages) {
    console.log(`${file}: ${found.code} ${found.pointer ?? ''}: ${found.message}`);
    process.exitCode = 1;
  }
}
