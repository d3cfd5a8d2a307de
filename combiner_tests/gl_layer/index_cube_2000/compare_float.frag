#version 130
// The comparison in floating point: no difference is lost.
uniform samplerCube map;
void main() {
  vec3 d = gl_Color.rgb - textureCube(map, gl_TexCoord[0].stp).rgb;
  gl_FragColor = vec4(0.0, 0.0, 0.0, dot(d, d) > 1e-7 ? 1.0 : 0.0);
}
