/* The calls of nxdk's pbkit that the kit for an Xbox uses, as far as it uses them. player.c has them. */
#pragma once
#include <stdint.h>
int pb_init(void);
void pb_kill(void);
void pb_show_front_screen(void);
void pb_show_debug_screen(void);
unsigned pb_wait_for_vbl(void);
void pb_reset(void);
void pb_target_back_buffer(void);
void pb_fill(int x, int y, int width, int height, unsigned color);
int pb_busy(void);
int pb_finished(void);
uint32_t* pb_begin(void);
void pb_push(uint32_t* p, uint32_t command, uint32_t count);
void pb_push1(uint32_t* p, uint32_t command, uint32_t value);
void pb_end(uint32_t* end);
uint32_t* pb_back_buffer(void);
unsigned pb_back_buffer_pitch(void);
