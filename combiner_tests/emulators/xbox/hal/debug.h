/* Of nxdk: what the kit uses. */
#pragma once
void debugPrint(const char* format, ...);
