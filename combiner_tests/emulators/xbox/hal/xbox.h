/* Of nxdk; the kit uses nothing of it that is not elsewhere. */
#pragma once
