// Draws of wi given wo, nearly as f_r cos(theta_i) is distributed. At each of some nodes of cos(theta_o), and linear
// between them, a mixture of components: each the product of two margins, of a polar coordinate and of an azimuth.
// The first components are of the half vector, over a unit disk with the horizon as its circle and the mirror
// direction in its middle; the others are of wi, over its projection.

// Two neighbouring nodes: where the numbers of the first begin, the share of the second.
struct sklar_Nodes {
  int first;
  float share;
};

// A margin of a component, linear between its knots: where its densities begin and how far apart they are, where the
// cdf at the upper ends of its cells begins, how many cells there are.
struct sklar_Margin {
  int densities;
  int stride;
  int cdf;
  int cells;
};

// wo: the sine and cosine of theta_o, the direction of wo in the plane of the surface.
struct sklar_Outgoing {
  float sine;
  float cosine;
  vec2 along;
};

// A point of the plane as margins take it, and the density of these coordinates per solid angle of wi.
struct sklar_Point {
  float polar;
  float azimuth;
  float measure;
};

// The coordinate of the disk in which margins are tabulated: about |m|^2 up to core^2, from there about log |m|.
struct sklar_Warp {
  float spread;
  float core;
  float core4;
  float scale;
};

struct sklar_Sample {
  vec3 wi;
  float pdf;
  vec3 weight;
};

sklar_Nodes sklar_nodes(float cosine) {
  int node = 0;
  for (int i = 1; i < sklar_outgoing_nodes - 1; ++i) {
    if (sklar_value(sklar_cosines + i) > cosine) node = i;
  }
  float from = sklar_value(sklar_cosines + node), to = sklar_value(sklar_cosines + node + 1);
  sklar_Nodes nodes;
  nodes.first = sklar_tables + node * sklar_node_size;
  nodes.share = max(from - cosine, 0.0) / (from - to);
  return nodes;
}

// Entry i of the tables between the nodes.
float sklar_entry(sklar_Nodes nodes, int i) {
  return mix(sklar_value(nodes.first + i), sklar_value(nodes.first + sklar_node_size + i), nodes.share);
}

sklar_Margin sklar_margin(int densities, int cdf, int k, int count, int cells) {
  sklar_Margin margin;
  margin.densities = densities + k;
  margin.stride = count;
  margin.cdf = cdf + k * cells;
  margin.cells = cells;
  return margin;
}

sklar_Margin sklar_polar_margin(int k) {
  if (k < sklar_of_half) {
    return sklar_margin(sklar_half_polar, sklar_half_polar_cdf, k, sklar_of_half, sklar_half_polar_cells);
  }
  return sklar_margin(sklar_wi_polar, sklar_wi_polar_cdf, k - sklar_of_half, sklar_of_wi, sklar_wi_polar_cells);
}

sklar_Margin sklar_azimuth_margin(int k) {
  if (k < sklar_of_half) {
    return sklar_margin(sklar_half_azimuth, sklar_half_azimuth_cdf, k, sklar_of_half, sklar_half_azimuth_cells);
  }
  return sklar_margin(sklar_wi_azimuth, sklar_wi_azimuth_cdf, k - sklar_of_half, sklar_of_wi, sklar_wi_azimuth_cells);
}

float sklar_density(sklar_Nodes nodes, sklar_Margin margin, float coordinate) {
  sklar_Between at = sklar_between(coordinate * float(margin.cells), margin.cells);
  int i = margin.densities + at.low * margin.stride;
  return mix(sklar_entry(nodes, i), sklar_entry(nodes, i + margin.stride), at.share);
}

// The coordinate at which the cdf of a margin is `level`: x / y, with y > 0.
vec2 sklar_inverse(sklar_Nodes nodes, sklar_Margin margin, float level) {
  int cell = 0;
  for (int i = 0; i < margin.cells - 1; ++i) {
    if (sklar_entry(nodes, margin.cdf + i) <= level) cell = i + 1;
  }
  int i = margin.densities + cell * margin.stride;
  float first = sklar_entry(nodes, i), last = sklar_entry(nodes, i + margin.stride);
  float cells = float(margin.cells);
  float mass = max((level - sklar_entry(nodes, margin.cdf + cell)) * cells + 0.5 * (first + last), 0.0);
  float root = first + sqrt(max(first * first + 2.0 * (last - first) * mass, 0.0));
  return vec2(float(cell) * root + min(2.0 * mass, root), cells * root);
}

// wo above the horizon. Below a cosine of 1e-8 nothing changes any more.
sklar_Outgoing sklar_outgoing(vec3 wo) {
  sklar_Outgoing given;
  given.sine = sqrt(wo.x * wo.x + wo.y * wo.y);
  given.cosine = max(wo.z, 1e-8);
  given.along = given.sine > 1e-18 ? vec2(wo.x / given.sine, wo.y / given.sine) : vec2(1.0, 0.0);
  return given;
}

sklar_Warp sklar_warp(float spread) {
  sklar_Warp warp;
  warp.spread = spread;
  warp.core = 0.2 * spread;
  warp.core4 = (warp.core * warp.core) * (warp.core * warp.core);
  warp.scale = 1.0 + spread / (1.0 - warp.core);
  return warp;
}

// Half a turn of the vector (x, y) from the x axis as a number in [0,1], tan(phi / 2) / 2 up to pi / 2 and mirrored
// beyond; and its slope by phi.
vec2 sklar_folded(float x, float y, float length_xy) {
  float tangent = abs(y) / (length_xy + abs(x) + 1e-30);
  return vec2(x < 0.0 ? 1.0 - 0.5 * tangent : 0.5 * tangent, 0.25 + 0.25 * tangent * tangent);
}

sklar_Point sklar_half_point(sklar_Outgoing given, sklar_Warp warp, vec3 wo, vec3 wi) {
  vec3 sum = wi + wo;
  float along = sum.x * given.along.x + sum.y * given.along.y;
  float across = sum.y * given.along.x - sum.x * given.along.y;
  float level2 = along * along + across * across, sum2 = level2 + sum.z * sum.z;
  float up = given.cosine * sum.z, a = up + given.sine * along, b = given.sine * across, below2 = a * a + b * b;
  vec2 folded = sklar_folded(up * along + given.sine * level2, up * across, sqrt(level2) * sqrt(below2));
  float area = 0.5 * (given.cosine * sum2 / below2) * (up / below2);

  float disk2 = min(level2 / below2, 1.0);
  float g2 = sqrt(warp.core4 + (1.0 - warp.core4) * disk2), g = sqrt(g2), inverse = 1.0 / (warp.spread + g - warp.core);
  sklar_Point at;
  at.polar = clamp(warp.scale * (g - warp.core) * inverse, 0.0, 1.0);
  at.azimuth = folded.x;
  at.measure = warp.scale * warp.spread * 0.25 * (1.0 - warp.core4) * inverse * inverse / (g2 * g) * folded.y * area;
  return at;
}

sklar_Point sklar_wi_point(sklar_Outgoing given, vec3 wi) {
  float x = wi.x * given.along.x + wi.y * given.along.y, y = wi.y * given.along.x - wi.x * given.along.y;
  sklar_Point at;
  at.polar = min(wi.x * wi.x + wi.y * wi.y, 1.0);
  vec2 folded = sklar_folded(x, y, sqrt(at.polar));
  at.azimuth = folded.x;
  at.measure = folded.y * wi.z;
  return at;
}

// Density of the draws of sklar_sample per solid angle of wi; 0 where either direction is not above the horizon.
float sklar_pdf(vec3 wo, vec3 wi) {
  if (!(wo.z > 0.0 && wi.z > 0.0)) return 0.0;
  sklar_Nodes nodes = sklar_nodes(wo.z);
  sklar_Outgoing given = sklar_outgoing(wo);
  sklar_Point of_half = sklar_half_point(given, sklar_warp(sklar_entry(nodes, sklar_spread)), wo, wi);
  sklar_Point of_wi = sklar_wi_point(given, wi);
  float sum = 0.0, before = 0.0;
  for (int k = 0; k < sklar_of_half + sklar_of_wi; ++k) {
    sklar_Point at = of_wi;
    if (k < sklar_of_half) at = of_half;
    float upto = sklar_entry(nodes, sklar_shares + k + 1);
    sum += (upto - before) * at.measure * sklar_density(nodes, sklar_polar_margin(k), at.polar) *
           sklar_density(nodes, sklar_azimuth_margin(k), at.azimuth);
    before = upto;
  }
  return mix(sum, 0.3183098861837907 * wi.z, sklar_cosine_share);
}

// wi of a point (x, y) of the disk, x^2 + y^2 = square: along wo's direction in the plane of the surface, across, up.
vec3 sklar_from_disk(sklar_Outgoing given, float x, float y, float square) {
  float c2 = given.cosine * given.cosine, away = 1.0 - given.sine * x;
  float d = away * away + given.sine * y * given.sine * y, d_up = d + c2 * square;
  float factor = 2.0 * (c2 / d_up) * (away / max(d, 1e-30));  // d = 0 has away = 0
  return vec3(factor * (x - given.sine * square) - given.sine, factor * y, given.cosine * (1.0 - square) / d_up);
}

vec3 sklar_cosine_draw(vec2 uniforms) {
  float radius = sqrt(uniforms.x), phi = 6.283185307179586 * uniforms.y;
  return vec3(radius * cos(phi), radius * sin(phi), sqrt(1.0 - uniforms.x));
}

vec3 sklar_draw(vec3 wo, vec2 uniforms) {
  if (!(wo.z > 0.0)) return sklar_cosine_draw(uniforms);
  if (uniforms.x < sklar_cosine_share) return sklar_cosine_draw(vec2(uniforms.x / sklar_cosine_share, uniforms.y));
  sklar_Nodes nodes = sklar_nodes(wo.z);
  sklar_Outgoing given = sklar_outgoing(wo);
  float chance = (uniforms.x - sklar_cosine_share) / (1.0 - sklar_cosine_share);
  int k = 0;
  for (int i = 1; i < sklar_of_half + sklar_of_wi; ++i) {
    if (sklar_entry(nodes, sklar_shares + i) <= chance) k = i;
  }
  float from = sklar_entry(nodes, sklar_shares + k), to = sklar_entry(nodes, sklar_shares + k + 1);
  float turned = clamp(2.0 * (chance - from) / (to - from) - 1.0, -1.0, 1.0);
  vec2 azimuth = sklar_inverse(nodes, sklar_azimuth_margin(k), abs(turned));
  vec2 polar = sklar_inverse(nodes, sklar_polar_margin(k), uniforms.y);

  // Back from the folded half turn, which is mirrored where `behind` is negative.
  float behind = azimuth.y - 2.0 * azimuth.x, tangent = azimuth.y - abs(behind);
  float inverse = 1.0 / (azimuth.y * azimuth.y + tangent * tangent);
  float cosine = (azimuth.y * azimuth.y - tangent * tangent) * inverse, sine = 2.0 * azimuth.y * tangent * inverse;
  if (behind < 0.0) cosine = -cosine;
  if (turned < 0.0) sine = -sine;

  vec3 local;
  if (k < sklar_of_half) {
    sklar_Warp warp = sklar_warp(sklar_entry(nodes, sklar_spread));
    float y = polar.x * warp.spread / (warp.scale * polar.y - polar.x), g = warp.core + y;
    float square = y * (warp.core + g) * (warp.core * warp.core + g * g) / (1.0 - warp.core4), radius = sqrt(square);
    local = sklar_from_disk(given, radius * cosine, radius * sine, square);
  } else {
    float square = min(polar.x / polar.y, 1.0), radius = sqrt(square);
    local = vec3(radius * cosine, radius * sine, sqrt(1.0 - square));
  }
  return vec3(local.x * given.along.x - local.y * given.along.y, local.x * given.along.y + local.y * given.along.x,
              local.z);
}

// A draw of wi given wo from two uniforms in (0,1), its density, and its weight f_r cos(theta_i) / pdf.
sklar_Sample sklar_sample(vec3 wo, vec2 uniforms) {
  sklar_Sample drawn;
  drawn.wi = sklar_draw(wo, uniforms);
  drawn.pdf = sklar_pdf(wo, drawn.wi);
  drawn.weight = vec3(0.0, 0.0, 0.0);
  if (drawn.pdf > 0.0) drawn.weight = drawn.wi.z / drawn.pdf * sklar_eval(wo, drawn.wi);
  return drawn;
}
