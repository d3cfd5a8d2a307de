/* Of nxdk: what the kit uses. */
#pragma once
void* MmAllocateContiguousMemoryEx(unsigned bytes, unsigned lowest, unsigned highest, unsigned alignment,
                                   unsigned protection);
