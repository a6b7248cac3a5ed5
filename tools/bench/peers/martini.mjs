// martini.mjs GRID METRES OUT.ply: @mapbox/martini (right-triangulated network) down to a largest error, as it
// reckons it. Squares of 2^k + 1 samples only.

import Martini from '@mapbox/martini';
import {printResult, readGrid, timed, writePly} from './grid.mjs';

const [path, metres, output] = process.argv.slice(2);
const grid = readGrid(path);
const [mesh, seconds] = timed(() => {
    const {vertices, triangles} = new Martini(grid.width).createTile(grid.z).getMesh(Number(metres) / grid.unit);
    return {coords: vertices, triangles};
});
writePly(output, grid, mesh);
printResult(seconds, mesh.triangles);
