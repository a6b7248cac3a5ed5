// delatin.mjs GRID METRES OUT.ply: delatin (greedy insertion) down to a largest error.
// delatin.mjs GRID METRES --check: the same mesh, measured here instead of by the judge (no file is written).

import Delatin from 'delatin';
import {printResult, readGrid, timed, writePly} from './grid.mjs';

/**
 * Largest error and RMSE, in metres, of a mesh whose vertices are samples, over all samples: each triangle is
 * asked for its height at every sample of its bounding box, and a sample on an edge counts once. A second, independent
 * measurement, to see whether the judge can be trusted.
 */
function measure(grid, {coords, triangles}) {
    const {width, z, unit} = grid;
    const seen = new Uint8Array(z.length);
    let largest = 0, sum = 0, n = 0;
    for (let t = 0; t < triangles.length; t += 3) {
        const [a, b, c] = [triangles[t], triangles[t + 1], triangles[t + 2]];
        const [ax, ay, bx, by, cx, cy] = [a, b, c].flatMap((v) => [coords[2 * v], coords[2 * v + 1]]);
        const [az, bz, cz] = [z[ay * width + ax], z[by * width + bx], z[cy * width + cx]];
        const area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
        for (let y = Math.min(ay, by, cy); y <= Math.max(ay, by, cy); y++) {
            for (let x = Math.min(ax, bx, cx); x <= Math.max(ax, bx, cx); x++) {
                const u = ((bx - x) * (cy - y) - (by - y) * (cx - x)) / area;
                const v = ((cx - x) * (ay - y) - (cy - y) * (ax - x)) / area;
                const w = ((ax - x) * (by - y) - (ay - y) * (bx - x)) / area;
                const i = y * width + x;
                if (u < 0 || v < 0 || w < 0 || seen[i]) continue;
                seen[i] = 1;
                const error = Math.abs(u * az + v * bz + w * cz - z[i]) * unit;
                largest = Math.max(largest, error);
                sum += error * error;
                n++;
            }
        }
    }
    return {max_error: largest, rmse: Math.sqrt(sum / n), covered: n};
}

const [path, metres, output] = process.argv.slice(2);
const grid = readGrid(path);
const [mesh, seconds] = timed(() => {
    const made = new Delatin(grid.z, grid.width, grid.height);
    made.run(Number(metres) / grid.unit);
    return made;
});
if (output === '--check') {
    printResult(seconds, mesh.triangles, measure(grid, mesh));
} else {
    writePly(output, grid, mesh);
    printResult(seconds, mesh.triangles);
}
