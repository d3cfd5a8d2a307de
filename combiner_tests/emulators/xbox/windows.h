/* Of nxdk: what the kit uses. */
#pragma once
void Sleep(unsigned milliseconds);
