// Two pictures of the same size, one on the other, with a divider between them: by mouse, touch and keyboard.
// The element needs the styles of the classes "swipe", "swipe-side", "swipe-divider" and "swipe-name".

const swipeSteps = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageDown: -10, PageUp: 10 };

function swipeSide(container, side) {
  const box = document.createElement("div");
  box.className = `swipe-side ${side}`;
  const picture = document.createElement("img");
  picture.draggable = false;
  const overlay = document.createElement("canvas");
  const name = document.createElement("span");
  name.className = `swipe-name ${side}`;
  box.append(picture, overlay);
  container.append(box, name);
  return { box, picture, overlay, name };
}

// Returns { element, show(side, { name, url, overlay }), moveTo(percent) }. `side` is "left" or "right"; `overlay` is a
// canvas that is drawn on the picture, or nothing.
export function pictureSwipe(width, height) {
  const element = document.createElement("div");
  element.className = "swipe";
  element.style.aspectRatio = `${width} / ${height}`;
  element.style.maxWidth = `calc(80vh * ${width / height})`;
  const sides = { right: swipeSide(element, "right"), left: swipeSide(element, "left") };
  const divider = document.createElement("div");
  divider.className = "swipe-divider";
  divider.tabIndex = 0;
  divider.setAttribute("role", "slider");
  divider.setAttribute("aria-label", "Divider between the two pictures");
  divider.setAttribute("aria-valuemin", "0");
  divider.setAttribute("aria-valuemax", "100");
  const handle = document.createElement("span");
  handle.setAttribute("aria-hidden", "true");
  divider.append(handle);
  element.append(divider);

  let at = 50;
  function moveTo(percent) {
    at = Math.min(100, Math.max(0, percent));
    divider.style.left = `${at}%`;
    sides.left.box.style.clipPath = `inset(0 ${100 - at}% 0 0)`;
    divider.setAttribute("aria-valuenow", String(Math.round(at)));
    divider.setAttribute("aria-valuetext", `${Math.round(at)} % ${sides.left.name.textContent}`);
  }

  const follow = (event) => {
    const box = element.getBoundingClientRect();
    moveTo(((event.clientX - box.left) / box.width) * 100);
  };
  element.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    element.setPointerCapture(event.pointerId);
    divider.focus({ preventScroll: true });
    follow(event);
  });
  element.addEventListener("pointermove", (event) => {
    if (element.hasPointerCapture(event.pointerId)) follow(event);
  });
  divider.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const step = swipeSteps[event.key];
    if (step !== undefined) moveTo(at + step * (event.shiftKey ? 10 : 1));
    else if (event.key === "Home") moveTo(0);
    else if (event.key === "End") moveTo(100);
    else return;
    event.preventDefault();
  });

  function show(side, { name, url, overlay }) {
    const part = sides[side];
    if (part.picture.src !== url) part.picture.src = url;
    part.picture.alt = name;
    part.name.textContent = name;
    part.overlay.width = width;
    part.overlay.height = height;
    if (overlay) part.overlay.getContext("2d").drawImage(overlay, 0, 0, width, height);
    moveTo(at);
  }

  moveTo(at);
  return { element, show, moveTo };
}
