/* Of nxdk: what the kit uses. */
#pragma once
enum { REFRESH_DEFAULT = 0 };
int XVideoSetMode(int width, int height, int bits, int refresh);
