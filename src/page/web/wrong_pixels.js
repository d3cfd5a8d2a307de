// Wrong pixels as pictures: in the colour of their cause, or as a heat map.

// Colours that colour-blind readers can distinguish (Okabe and Ito), by cause.
export const causeColors = {
  truncation: "#e69f00", joint: "#56b4e9", vanished: "#009e73", shared: "#f0e442",
  acne: "#d55e00", detached: "#cc79a7", sampling: "#4a7dff",
};
export const causeHelp = {
  truncation: "two different indices compare equal in the combiners",
  joint: "the texel holds a neighbour of the polygon on the same surface",
  vanished: "the polygon owns no texel of the map",
  shared: "the polygon that casts the shadow has the same index",
  acne: "the polygon shadows itself or its neighbour",
  detached: "the comparison lets light through under a contact",
  sampling: "the texel's centre does not see what the pixel sees",
};

// Dark violet over red to light yellow: lighter is more.
export const heatStops = [[58, 12, 92], [150, 26, 105], [217, 70, 61], [248, 149, 48], [252, 244, 160]];
function heatColor(share) {
  const place = Math.min(1, share) * (heatStops.length - 1);
  const low = Math.min(heatStops.length - 2, Math.floor(place));
  return heatStops[low].map((value, c) => Math.round(value + (heatStops[low + 1][c] - value) * (place - low)));
}

const rgbOf = (color) => [1, 3, 5].map((at) => parseInt(color.slice(at, at + 2), 16));

// The functions for pictures of this size, whose planes hold a number of `causes` for each wrong pixel, plus 128 if it is
// falsely lit.
export function wrongPixels(width, height, causes) {
  async function pixelsOf(url) {
    const picture = new Image();
    picture.src = url;
    await picture.decode();
    const canvas = new OffscreenCanvas(width, height);
    const context = canvas.getContext("2d", { willReadFrequently: true });
    context.drawImage(picture, 0, 0);
    const { data: rgba } = context.getImageData(0, 0, width, height);
    const plane = new Uint8Array(width * height);
    for (let i = 0; i < plane.length; ++i) plane[i] = rgba[4 * i];
    return plane;
  }

  function canvasOf(paint) {
    const canvas = document.createElement("canvas");
    canvas.width = width;
    canvas.height = height;
    const context = canvas.getContext("2d");
    const image = context.createImageData(width, height);
    paint(image.data);
    context.putImageData(image, 0, 0);
    return canvas;
  }

  // Each wrong pixel in the colour of its cause. `cause`: a number of causes; 0: all.
  function pointsOf(row, cause) {
    const colors = causes.map((name) => rgbOf(causeColors[name] ?? "#000000"));
    return canvasOf((out) => {
      row.plane.forEach((value, i) => {
        const number = value & 127;
        if (number === 0 || (cause !== 0 && number !== cause)) return;
        out.set(colors[number], 4 * i);
        out[4 * i + 3] = 255;
      });
    });
  }

  const heatRadius = Math.max(2, Math.round(width / 100));

  // The share of wrong pixels in the square around each pixel.
  function densityOf(row, cause) {
    const w = width, h = height;
    const sums = new Uint32Array((w + 1) * (h + 1));
    for (let y = 0; y < h; ++y) {
      let line = 0;
      for (let x = 0; x < w; ++x) {
        const number = row.plane[y * w + x] & 127;
        if (number !== 0 && (cause === 0 || number === cause)) ++line;
        sums[(y + 1) * (w + 1) + x + 1] = sums[y * (w + 1) + x + 1] + line;
      }
    }
    const density = new Float32Array(w * h);
    for (let y = 0; y < h; ++y) {
      const top = Math.max(0, y - heatRadius), bottom = Math.min(h, y + heatRadius + 1);
      for (let x = 0; x < w; ++x) {
        const left = Math.max(0, x - heatRadius), right = Math.min(w, x + heatRadius + 1);
        const sum = sums[bottom * (w + 1) + right] - sums[top * (w + 1) + right] - sums[bottom * (w + 1) + left] +
          sums[top * (w + 1) + left];
        density[y * w + x] = sum / ((bottom - top) * (right - left));
      }
    }
    return density;
  }

  function heatOf(density, most) {
    return canvasOf((out) => {
      density.forEach((value, i) => {
        if (value === 0) return;
        const share = Math.sqrt(value / most);
        out.set(heatColor(share), 4 * i);
        out[4 * i + 3] = Math.round(255 * Math.min(1, 0.35 + share));
      });
    });
  }

  return { pixelsOf, pointsOf, densityOf, heatOf, heatRadius };
}
