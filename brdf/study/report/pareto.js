// Error against cost.

/// Those that no other beats in cost x and error y, from cheap to dear.
function front(points) {
  let least = Infinity;
  return [...points].sort((a, b) => a.x - b.x || a.y - b.y).filter((point) => {
    const best = point.y < least;
    least = Math.min(least, point.y);
    return best;
  });
}
