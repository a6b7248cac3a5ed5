// What the peers in JavaScript share: reading a grid file (grid.hpp says what it holds) and writing the PLY that
// the judge reads. A mesh is {coords: [column, row, ...], triangles: [a, b, c, ...]}, its vertices are samples.

import {closeSync, openSync, readFileSync, writeSync} from 'node:fs';

/** The grid's header and its heights (z), which must be without voids: no peer in JavaScript knows any. */
export function readGrid(path) {
    const bytes = readFileSync(path);
    const start = bytes.indexOf('\n') + 1;
    const grid = JSON.parse(bytes.toString('utf8', 0, start));
    if (grid.has_voids) throw new Error(`${path}: has voids; make it from what dump --fill writes`);
    grid.z = new Float32Array(bytes.buffer, bytes.byteOffset + start, grid.width * grid.height);
    return grid;
}

function planArea(coords, triangles) {
    let sum = 0;
    for (let t = 0; t < triangles.length; t += 3) {
        const [a, b, c] = [2 * triangles[t], 2 * triangles[t + 1], 2 * triangles[t + 2]];
        sum += (coords[b] - coords[a]) * (coords[c + 1] - coords[a + 1]) -
            (coords[b + 1] - coords[a + 1]) * (coords[c] - coords[a]);
    }
    return sum / 2;
}

/** Sample (0, 0) is the centre of the upper left cell. */
function vertexBytes(grid, coords) {
    const g = grid.geotransform;
    const xyz = new Float64Array(coords.length / 2 * 3);
    for (let v = 0; 2 * v < coords.length; v++) {
        const column = coords[2 * v];
        const row = coords[2 * v + 1];
        xyz[3 * v] = g[0] + (column + 0.5) * g[1] + (row + 0.5) * g[2];
        xyz[3 * v + 1] = g[3] + (column + 0.5) * g[4] + (row + 0.5) * g[5];
        xyz[3 * v + 2] = grid.z[row * grid.width + column];
    }
    return Buffer.from(xyz.buffer);
}

function triangleBytes(triangles, isClockwise) {
    const bytes = Buffer.alloc(triangles.length / 3 * 13);
    for (let t = 0, at = 0; t < triangles.length; t += 3, at += 13) {
        bytes.writeUInt8(3, at);
        bytes.writeUInt32LE(triangles[t], at + 1);
        bytes.writeUInt32LE(triangles[t + (isClockwise ? 2 : 1)], at + 5);
        bytes.writeUInt32LE(triangles[t + (isClockwise ? 1 : 2)], at + 9);
    }
    return bytes;
}

/** PLY in the CRS of the grid, counter-clockwise in plan. */
export function writePly(path, grid, {coords, triangles}) {
    const g = grid.geotransform;
    const isMirrored = g[1] * g[5] - g[2] * g[4] < 0;
    const isClockwise = planArea(coords, triangles) < 0 !== isMirrored;
    const header = `ply\nformat binary_little_endian 1.0\ncomment crs ${grid.crs}\n` +
        `element vertex ${coords.length / 2}\nproperty double x\nproperty double y\nproperty double z\n` +
        `element face ${triangles.length / 3}\nproperty list uchar int vertex_indices\nend_header\n`;
    const file = openSync(path, 'w');
    for (const part of [Buffer.from(header), vertexBytes(grid, coords), triangleBytes(triangles, isClockwise)]) {
        for (let at = 0; at < part.length;) at += writeSync(file, part, at);
    }
    closeSync(file);
}

/** Runs f and says how long it took, in seconds. */
export function timed(f) {
    const start = performance.now();
    const result = f();
    return [result, (performance.now() - start) / 1000];
}

/** What a peer prints: its own seconds, reading and writing of files not included, and its triangles. */
export function printResult(seconds, triangles, rest = {}) {
    console.log(JSON.stringify({own_seconds: seconds, triangles: triangles.length / 3, ...rest}));
}
