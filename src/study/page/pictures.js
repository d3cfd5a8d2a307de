// Error pictures that say what stands at a pixel and why it is wrong. A module of its own behind the page's script, which has the data.
for (const [number, { wrong, causes, traces }] of data.pictures.entries()) {
  if (!wrong) continue;
  const figure = document.getElementById("picture-" + number), picture = figure.querySelector("img");
  await picture.decode();
  const { naturalWidth: width, naturalHeight: height } = picture;  // it may be shown smaller
  const context = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
  context.drawImage(picture, 0, 0);
  const { data: rgba } = context.getImageData(0, 0, width, height);
  const row = { name: picture.alt, rgba, plane: await wrongPixels(width, height, causes).pixelsOf(wrong), traces };
  const { watch, list } = pictureProbe(figure, width, height, causes);
  watch(picture, () => row);
  list(figure, row);
}
