// Contours of the density of a copula of two coordinates.

const kLevels = [0.125, 0.25, 0.5, 1, 2, 4, 8];

/// The pieces of a contour, as pairs of points in units of cells, by marching squares: what lies between four nodes is
/// crossed where the level lies between two neighbours.
function contour(density, level) {
  const log = (i, j) => Math.log(Math.max(density[i][j], 1e-300) / level);
  const pieces = [];
  for (let i = 0; i + 1 < density.length; ++i) {
    for (let j = 0; j + 1 < density.length; ++j) {
      const corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
      const crossed = [];
      corners.forEach(([a, b], n) => {
        const [c, d] = corners[(n + 1) % 4];
        const from = log(a, b), to = log(c, d);
        if ((from < 0) === (to < 0)) return;
        const share = from / (from - to);
        crossed.push([a + share * (c - a), b + share * (d - b)]);
      });
      for (let n = 0; n + 1 < crossed.length; n += 2) pieces.push([crossed[n], crossed[n + 1]]);
    }
  }
  return pieces;
}
