"""MPlayer of the distribution converts colours by register combiners: `-vo gl:yuv=1`, for the cards of its time.

The film is one picture of 48 patches, each of one colour. The display's own memory shows what MPlayer draws. The middle of
each patch, away from what filtering blends, is what `ninebit eval` gives for MPlayer's set-up, and within 3 of the colour by
the conversion's formula. Without the layer MPlayer reports missing functions and draws other colours.
"""
import subprocess
import time

import numpy

import pictures
from kit import HERE, display, require

PACKAGES = "mplayer, python3-numpy and xvfb"
ACROSS, DOWN, PATCH = 8, 6, 16
WIDTH, HEIGHT = ACROSS * PATCH, DOWN * PATCH
PROFILE = "nv2a"  # three texture units


def make_film(path):
    """Returns the patches' Y, U, V. The same picture for as many seconds as anybody waits."""
    random = numpy.random.default_rng(1)
    patches = random.integers(16, 241, (DOWN, ACROSS, 3), dtype=numpy.uint8)
    patches[0, :, 1:] = 128  # a row of greys
    planes = [patches[:, :, c].repeat(size, axis=0).repeat(size, axis=1) for c, size in ((0, PATCH), (2, 8), (1, 8))]
    path.write_bytes(b"".join(plane.tobytes() for plane in planes) * 60)
    return patches


def formula(patches):
    y, u, v = [patches[:, :, c].astype(float) - (128 if c else 0) for c in range(3)]
    rgb = numpy.stack([y + 1.403 * v, y - 0.344 * u - 0.714 * v, y + 1.77 * u], axis=-1)
    return numpy.clip(numpy.rint(rgb), 0, 255).astype(int)


def film_on_screen(kit, folder, environment, layer, options="yuv=1"):
    """The middles of the patches once they stand still, and MPlayer's messages."""
    command = ["mplayer", "-noconfig", "all", "-nosound", "-nolirc", "-noconsolecontrols", "-geometry", "0:0", "-vo",
               f"gl:{options}", "-msglevel", "vo=6", "-demuxer", "rawvideo", "-rawvideo",
               f"w={WIDTH}:h={HEIGHT}:format=yv12:fps=1", "film.yuv"]
    log = folder / f"{options.replace(':', '_')}_{'with' if layer else 'without'}_layer.log"
    with open(log, "wb") as output:
        player = subprocess.Popen(kit.command(command, layer, PROFILE), env=environment, cwd=folder,
                                  stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT)
        try:
            seen, last, end = numpy.zeros((HEIGHT, WIDTH, 3), numpy.uint8), None, time.monotonic() + 20
            while time.monotonic() < end and player.poll() is None:
                time.sleep(0.3)
                seen = pictures.read_xwd(folder / "Xvfb_screen0")[:HEIGHT, :WIDTH]
                if last is not None and seen.any() and (seen == last).all():
                    break
                last = seen
        finally:
            player.terminate()
            player.wait()
    pictures.write_png(log.with_suffix(".png"), seen)
    return seen[PATCH // 2::PATCH, PATCH // 2::PATCH].astype(int), log.read_text(errors="replace")


def run(kit):
    require(PACKAGES, ["mplayer", "Xvfb"])
    folder = kit.folder("mplayer")
    patches = make_film(folder / "film.yuv")
    columns = [f"tex{unit}.{c}" for unit in range(3) for c in "rgb"]
    rows = patches.reshape(-1, 3).repeat(3, axis=1).tolist()
    codes = kit.evaluate(HERE / "mplayer/yuv.gl", columns, rows, PROFILE)
    expected = numpy.clip(codes, 0, 255)[:, :3].reshape(DOWN, ACROSS, 3)

    with display(memory=folder) as environment:
        environment["HOME"] = str(folder)  # where it writes its settings
        seen, log = film_on_screen(kit, folder, environment, layer=False)
        off = abs(seen - formula(patches)).max()
        kit.check("Combiner functions missing" in log and off > 50,
                  f"mplayer, without the layer: combiner functions are missing, colours are off by up to {off}")
        for options in ("yuv=1", "yuv=1:rectangle=1"):  # textures with power-of-two sizes, and rectangle textures
            seen, log = film_on_screen(kit, folder, environment, True, options)
            wrong, off = (seen != expected).any(axis=-1).sum(), abs(seen - formula(patches)).max()
            kit.check("Combiner functions missing" not in log and "yuv = 1" in log,
                      f"mplayer, {options}: MPlayer uses combiners without a complaint")
            kit.check(wrong == 0, f"mplayer, {options}: {wrong} of {ACROSS * DOWN} patches differ from eval")
            kit.check(off <= 3, f"mplayer, {options}: colours are off the formula by up to {off}, at most 3")
