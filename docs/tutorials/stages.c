/* The texture-shader stages of an NV2A, for the runner of `ninebit vectors --texture-shader`. Compile it with another
   value of a macro, such as -DTRANSPOSED=1, to see how a mistake is found. */
#include <math.h>
#include <stdint.h>

#ifndef TRANSPOSED
#define TRANSPOSED 0 /* 1: the offset matrix is transposed */
#endif
#ifndef HILO_BITS
#define HILO_BITS 16 /* 8: the low bytes of HILO words are not read */
#endif
#ifndef EYE
#define EYE 1 /* 0: reflections do not use the eye */
#endif

typedef struct {
  int16_t texture[4][4];
  int culled, replaces_depth;
  uint32_t depth;
} StageResult;
void read_texel(int unit, const float at[3], uint8_t rgba[4]);

/* The places of words, as the lines `word` of a pack have them. */
enum { COMPARE, MODES, MAPPING, INPUT, MATRIX, EYE_VECTOR = MATRIX + 18, CONTROL0 = EYE_VECTOR + 3, FILTER };

static float number(uint32_t word) {
  union {
    uint32_t word;
    float number;
  } of;
  of.word = word;
  return of.number;
}
static int s8(int v) { return (v ^ 128) - 128; }
static int s16(int v) { return (v ^ 32768) - 32768; }
static int clamped(int v) { return v < 0 ? 0 : v > 255 ? 255 : v; }
static uint8_t byte_of(float c) {
  const float n = floorf(4096.0f * c);
  return (uint8_t)(255 * ((n > 4095.0f ? 4095 : n > 0.0f ? (int)n : 0) + 1) >> 12);
}
static float dot3(const float a[3], const float b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* The factor of a dot product. */
static void normal_of(unsigned mapping, const uint8_t v[4], float n[3]) {
  const int low_red = HILO_BITS == 16 ? v[0] : v[3], low_blue = HILO_BITS == 16 ? v[2] : v[1];
  const int high = s16(256 * v[3] + v[0]), low = s16(256 * v[1] + v[2]);
  const double left = 1073741824.0 - (double)high * high - (double)low * low;
  int k;
  for (k = 0; k < 3; ++k) {
    n[k] = mapping == 1   ? (float)(v[k] - 128) / 127.0f
           : mapping == 2 ? (float)(2 * s8(v[k]) + 1) / 255.0f
           : mapping == 3 ? (float)s8(v[k]) / 127.0f
                          : (float)v[k] / 255.0f;
  }
  if (mapping == 4) {
    n[0] = (float)(256 * v[3] + low_red) / 65535.0f;
    n[1] = (float)(256 * v[1] + low_blue) / 65535.0f;
    n[2] = 1.0f;
  } else if (mapping == 7) {
    n[0] = (float)high / 32767.0f;
    n[1] = (float)low / 32767.0f;
    n[2] = (float)floor(sqrt(left > 0.0 ? left : 0.0)) / 32768.0f;
  }
}

/* Red, green, blue of Y, U, V. */
static void convert(uint8_t v[4]) {
  const int f = 298 * v[0] >> 8, u = v[1] - 128, w = v[2] - 128;
  v[0] = (uint8_t)clamped(f + 2 * ((409 * w + 128) >> 9) - 19);
  v[1] = (uint8_t)clamped(f - 2 * (100 * u >> 9) - 2 * (208 * w >> 9) - 18);
  v[2] = (uint8_t)clamped(f + (516 * u >> 8) - 19);
}

void shade(const uint32_t words[], float at[4][4], StageResult *result) {
  uint8_t texel[4][4] = {{0}};
  float dots[4] = {0};
  int i, k, reads[4] = {0};
  for (i = 0; i < 4; ++i) {
    const unsigned mode = words[MODES] >> (5 * i) & 31;
    const unsigned from = i < 2 ? 0 : words[INPUT] >> (4 * i + 8) & 15;
    const uint8_t *input = texel[from];
    const uint32_t *set = i > 0 ? words + MATRIX + 6 * (i - 1) : words; /* matrix, scale, offset of a stage */
    float place[3] = {at[i][0], at[i][1], at[i][2]}, n[3];
    const int is_dot = mode >= 9 && mode <= 18 && mode != 15 && mode != 16;
    if (mode == 0) texel[i][3] = 255;
    if (is_dot) {
      normal_of(words[MAPPING] >> (4 * (i - 1)) & 7, input, n);
      dots[i] = dot3(at[i], n);
    }
    switch (mode) {
      case 1: case 2: /* projected */
        for (k = 0; k < 3; ++k) place[k] /= at[i][3];
        break;
      case 4: /* pass through */
        for (k = 0; k < 4; ++k) texel[i][k] = byte_of(at[i][k]);
        break;
      case 5: /* cull */
        for (k = 0; k < 4; ++k) result->culled |= (words[COMPARE] >> (4 * i + k) & 1) ? at[i][k] >= 0.0f : at[i][k] < 0.0f;
        break;
      case 6: case 7: { /* offset: words m00, m01, m11, m10 */
        const float ds = (float)s8(input[2]) / 128.0f, dt = (float)s8(input[1]) / 128.0f;
        place[0] += number(set[0]) * ds + number(set[TRANSPOSED ? 1 : 3]) * dt;
        place[1] += number(set[TRANSPOSED ? 3 : 1]) * ds + number(set[2]) * dt;
        break;
      }
      case 9: case 14: /* dot products in a 2D texture, or a cube map or 3D texture */
        for (k = 0; k < 3; ++k) place[k] = mode == 9 ? (k < 2 ? dots[i - 1 + k] : 0.0f) : dots[1 + k];
        break;
      case 10: /* depth */
        result->replaces_depth = 1;
        result->depth = dots[i - 1] > 65535.0f * dots[i] ? 65535 : (uint32_t)(dots[i - 1] / dots[i]);
        break;
      case 11: /* diffuse: the next stage's dot product, ahead */
        normal_of(words[MAPPING] >> 8 & 7, texel[words[INPUT] >> 20 & 15], n);
        place[0] = dots[1], place[1] = dots[2], place[2] = dot3(at[3], n);
        break;
      case 12: case 18: { /* the eye, reflected */
        const float *const d = dots + 1;
        float eye[3], along;
        for (k = 0; k < 3; ++k) eye[k] = mode == 12 ? at[1 + k][3] : number(words[EYE_VECTOR + k]);
        along = 2.0f * dot3(d, eye);
        for (k = 0; k < 3; ++k) place[k] = EYE ? d[k] * along - eye[k] * dot3(d, d) : d[k];
        break;
      }
      case 13: /* three dot products in a 3D texture */
        for (k = 0; k < 3; ++k) place[k] = dots[1 + k];
        break;
      case 15: case 16: /* dependent */
        place[0] = (float)input[mode == 15 ? 3 : 1] / 255.0f;
        place[1] = (float)input[mode == 15 ? 0 : 2] / 255.0f;
        break;
      default:
        break;
    }
    reads[i] = mode != 0 && mode != 4 && mode != 5 && mode != 10 && mode != 17;
    if (reads[i]) read_texel(i, place, texel[i]);
    for (k = 0; mode == 7 && k < 3; ++k) {
      texel[i][k] = byte_of((float)texel[i][k] / 255.0f * (number(set[4]) * ((float)input[0] / 255.0f) + number(set[5])));
    }
  }
  for (i = 0; i < 4; ++i) {
    static const int sign_bit[4] = {29, 30, 31, 28};
    if (reads[i] && words[CONTROL0] >> 28 == 1) convert(texel[i]);
    for (k = 0; k < 4; ++k) {
      const int is_signed = reads[i] && (words[FILTER + i] >> sign_bit[k] & 1);
      result->texture[i][k] = (int16_t)(is_signed ? 2 * s8(texel[i][k]) : texel[i][k]);
    }
  }
}
