// Error pictures that say what stands at a pixel. A module of its own behind the page's script, which has the data.
for (const [number, { wrong, causes, command }] of data.pictures.entries()) {
  if (!wrong) continue;
  const figure = document.getElementById("picture-" + number), picture = figure.querySelector("img");
  await picture.decode();
  const { naturalWidth: width, naturalHeight: height } = picture;
  const context = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
  context.drawImage(picture, 0, 0, width, height);
  const { data: rgba } = context.getImageData(0, 0, width, height);
  const row = { name: picture.alt, rgba, plane: await wrongPixels(width, height, causes).pixelsOf(wrong), command };
  pictureProbe(figure, width, height, causes)(picture, () => row);
}
