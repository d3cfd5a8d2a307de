#version 130
// The article's comparison in integers, written by hand: the rival of the layer.
uniform samplerCube map;
void main() {
  ivec3 index = ivec3(gl_Color.rgb * 255.0 + 0.5);
  ivec3 texel = ivec3(textureCube(map, gl_TexCoord[0].stp).rgb * 255.0 + 0.5);
  ivec3 d = clamp(4 * (index - texel), -255, 255);
  int sum = min(4 * (d.r * d.r + d.g * d.g + d.b * d.b) / 255, 255);
  gl_FragColor = vec4(0.0, 0.0, 0.0, float(sum) / 255.0);
}
