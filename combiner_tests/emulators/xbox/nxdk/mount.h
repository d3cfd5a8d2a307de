/* Of nxdk: what the kit uses. */
#pragma once
#include <stdbool.h>
bool nxIsDriveMounted(char letter);
bool nxMountDrive(char letter, const char* path);
