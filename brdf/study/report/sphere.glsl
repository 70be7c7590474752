#version 300 es
// A sphere seen from far away: a lamp, light from everywhere, and a fitted model. live.js puts the model's code, which
// is that of the library's export, where MODEL stands.
precision highp float;
precision highp int;
precision highp sampler2D;

uniform sampler2D values;  // the model's numbers, row after row
uniform sampler2D albedo;  // at theta_o = 0, 1, .. degrees
uniform mat3 view;         // from the world to the viewer
uniform vec3 light;        // toward the lamp, the viewer's frame
uniform vec3 irradiance, background;
uniform float sky, exposure, radius, size;
uniform float lines, soft;  // 1 to draw meridians, and to draw the edge smooth
out vec4 colour;

float sklar_value(int i) {
  int across = textureSize(values, 0).x;
  return texelFetch(values, ivec2(i % across, i / across), 0).r;
}

// MODEL

// IEC 61966-2-1.
vec3 srgb(vec3 v) {
  v = clamp(v, 0.0, 1.0);
  return mix(12.92 * v, 1.055 * pow(max(v, 1e-9), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, v));
}

// Of equal radiance from everywhere: the directional albedo.
vec3 sky_light(float cos_theta_o) {
  float x = degrees(acos(clamp(cos_theta_o, 0.0, 1.0)));
  int low = min(int(x), textureSize(albedo, 0).x - 2);
  vec3 one = texelFetch(albedo, ivec2(low, 0), 0).rgb, other = texelFetch(albedo, ivec2(low + 1, 0), 0).rgb;
  return sky * mix(one, other, min(x - float(low), 1.0));
}

vec3 reflected(vec3 normal) {
  vec3 tangent = normalize(cross(abs(normal.z) < 0.9 ? vec3(0, 0, 1) : vec3(1, 0, 0), normal));
  mat3 to_local = transpose(mat3(tangent, cross(normal, tangent), normal));
  vec3 wo = to_local * vec3(0, 0, 1), wi = to_local * light;
  vec3 lamp = wi.z > 0.0 ? sklar_eval(wo, wi) * wi.z * irradiance : vec3(0);
  return lamp + sky_light(normal.z);
}

// Lines every 30 degrees, so that a turned view shows.
float meridian(vec3 normal) {
  vec3 p = transpose(view) * normal;
  float across = length(p.xz);
  vec2 angles = vec2(asin(clamp(p.y, -1.0, 1.0)), across > 0.2 ? atan(p.x, p.z) : 0.26) * 6.0 / 3.14159265;
  vec2 off = abs(fract(angles + 0.5) - 0.5) * vec2(1.0, across);
  return lines * (1.0 - smoothstep(0.008, 0.018, min(off.x, off.y)));
}

void main() {
  vec2 p = (gl_FragCoord.xy / size * 2.0 - 1.0) / radius;
  float r = length(p);
  float inside = soft > 0.0 ? clamp((1.0 - r) * radius * size / 2.0 + 0.5, 0.0, 1.0) : float(r < 1.0);
  vec3 radiance = background;
  float line = 0.0;
  if (inside > 0.0) {
    p *= min(1.0, 0.99999 / max(r, 1e-9));  // a pixel on the edge has the normal of the nearest place on the sphere
    vec3 normal = vec3(p, sqrt(1.0 - dot(p, p)));
    radiance = mix(background, reflected(normal), inside);
    line = inside * meridian(normal);
  }
  colour = vec4(mix(srgb(exposure * radiance), vec3(0.6), 0.6 * line), 1.0);
}
