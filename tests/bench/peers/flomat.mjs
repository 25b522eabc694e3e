// Computes medial axes with FloMat many times in one process, so that neither start nor warm-up of node counts.
//
//     node flomat.mjs FOLDER INPUT.json
//
// FOLDER is where `npm install` put flo-mat. INPUT holds {warm_ms, most, cases: [{setting, options, loops}]};
// loops are arrays of Bezier curves, 2 to 4 points each. Prints one JSON object a case: CPU ms of each repetition, and
// all discs of the last one as [x, y, r, number of separate contacts].

import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

const [folder, input] = process.argv.slice(2);
const entry = createRequire(join(folder, 'package.json')).resolve('flo-mat');
const { findMats, CpNodeFs } = await import(pathToFileURL(entry));
const { warm_ms: warmMs, most, cases } = JSON.parse(readFileSync(input, 'utf8'));

function cpuMs(run) {
    const before = process.cpuUsage();
    run();
    const { user, system } = process.cpuUsage(before);
    return (user + system) / 1000;
}

// Repeats for `warmMs`, at least 3 and at most `most` times.
function repeated(run) {
    const times = [];
    const until = performance.now() + warmMs;
    while (times.length < Math.min(3, most) || (times.length < most && performance.now() < until)) {
        times.push(cpuMs(run));
    }
    return times;
}

// A disc bears one node for each contact, and two where it has but one contact.
function discs(mats) {
    const found = new Map();
    for (const mat of mats) {
        for (const node of CpNodeFs.getAllOnLoop(mat.cpNode)) {
            const { circle, pointOnShape } = node.cp;
            const key = circle.center.join() + ',' + circle.radius;
            if (!found.has(key)) { found.set(key, { circle, feet: [] }); }
            found.get(key).feet.push(pointOnShape.p);
        }
    }
    return [...found.values()].map(({ circle, feet }) => [...circle.center, circle.radius, separate(circle, feet)]);
}

function separate(circle, feet) {
    const kept = [];
    for (const [x, y] of feet) {
        if (kept.every(([a, b]) => Math.hypot(x - a, y - b) > 1e-6 * circle.radius)) { kept.push([x, y]); }
    }
    return kept.length;
}

for (const { setting, options, loops } of cases) {
    let mats = [];
    let answer;
    try {
        const run = () => { mats = findMats(loops, options); };
        repeated(run);
        answer = { setting, times: repeated(run), discs: discs(mats) };
    } catch (error) {
        answer = { setting, failure: String(error) };
    }
    process.stdout.write(JSON.stringify(answer) + '\n');
}
