#!/usr/bin/python3
"""Draws a mesh with a material by OGRE 1.12: draw_material.py FOLDER MATERIAL [MATERIAL ...]

FOLDER has the material scripts, their programs and pictures, and gets MATERIAL.png for each, 64 x 64 pixels with alpha,
drawn into a texture, and MATERIAL_window.png, drawn into a window. The mesh is a square of 8 x 8 cells, each of one
colour: `colors.txt` has 64 lines of red, green, blue, alpha, from 0 to 255. A cell shows one texel of a picture of 8 x 8.
The output lists the shader profiles of OGRE's OpenGL render system. The script is not
specific to combiners: the materials name their programs. Exit status 2: a material's program is not supported.
"""
import os
import sys

import Ogre

CELLS, SIZE = 8, 64


def start(folder):
    """OGRE with its OpenGL render system and the folder's materials."""
    log = Ogre.LogManager()
    log.createLog(os.path.join(folder, "ogre.log"), True, False)  # and not to the screen
    root = Ogre.Root("", "", "")
    for plugin in ("RenderSystem_GL", "Codec_STBI"):
        root.loadPlugin(os.path.join(os.environ["OGRE_PLUGINS"], plugin))
    root.setRenderSystem(root.getRenderSystemByName("OpenGL Rendering Subsystem"))
    root.initialise(False)
    window = root.createRenderWindow("ninebit", SIZE, SIZE, False)
    groups = Ogre.ResourceGroupManager.getSingleton()
    groups.addResourceLocation(folder, "FileSystem", "General")
    groups.initialiseAllResourceGroups()
    return log, root, window


def make_mesh(scene, folder):
    with open(os.path.join(folder, "colors.txt"), encoding="ascii") as file:
        colors = [[int(word) for word in line.split()] for line in file]
    cells = scene.createManualObject("cells")
    cells.begin("BaseWhiteNoLighting", Ogre.RenderOperation.OT_TRIANGLE_LIST)
    for number, color in enumerate(colors):
        row, column = divmod(number, CELLS)
        for dy in (0, 1):
            for dx in (0, 1):
                u, v = (column + dx) / CELLS, (row + dy) / CELLS
                cells.position(2 * u - 1, 1 - 2 * v, 0)
                cells.colour(*[(c + 0.25) / 255 for c in color])  # OGRE truncates to bytes
                cells.textureCoord(u, v)
        cells.quad(4 * number + 2, 4 * number + 3, 4 * number + 1, 4 * number)
    cells.end()
    return cells.convertToMesh("cells")


def make_scene(root, folder):
    scene = root.createSceneManager()
    entity = scene.createEntity(make_mesh(scene, folder))
    scene.getRootSceneNode().createChildSceneNode().attachObject(entity)
    camera = scene.createCamera("camera")
    node = scene.getRootSceneNode().createChildSceneNode()
    node.attachObject(camera)
    node.setPosition(0, 0, 5)
    camera.setProjectionType(Ogre.PT_ORTHOGRAPHIC)
    camera.setOrthoWindow(2, 2)
    camera.setNearClipDistance(1)
    return entity, camera


def main():
    folder, materials = sys.argv[1], sys.argv[2:]
    log, root, window = start(folder)  # the log lives as long as the variable
    with open(os.path.join(folder, "ogre.log"), encoding="utf-8", errors="replace") as file:
        profiles = next(line for line in file if "Supported Shader Profiles:" in line).split("Profiles:")[1].split()
    print("profiles: " + " ".join(profiles))
    print("fp20: " + ("yes" if Ogre.GpuProgramManager.getSingleton().isSyntaxSupported("fp20") else "no"), flush=True)

    entity, camera = make_scene(root, folder)
    picture = Ogre.TextureManager.getSingleton().createManual("picture", "General", Ogre.TEX_TYPE_2D, SIZE, SIZE, 1, 0,
                                                              Ogre.PF_BYTE_RGBA, Ogre.TU_RENDERTARGET)
    target = picture.getBuffer().getRenderTarget()
    for each in (target, window):
        each.addViewport(camera).setBackgroundColour(Ogre.ColourValue(1, 0, 1, 1))
    status = 0
    for name in materials:
        material = Ogre.MaterialManager.getSingleton().getByName(name, "General")
        material.load()
        if not material.getBestTechnique():
            print(f"{name}: not supported: {material.getUnsupportedTechniquesExplanation().strip()}")
            status = 2
            continue
        entity.setMaterial(material)
        target.update()
        target.writeContentsToFile(os.path.join(folder, f"{name}.png"))
        window.update()
        window.writeContentsToFile(os.path.join(folder, f"{name}_window.png"))
        print(f"{name}: drawn")
    sys.stdout.flush()
    os._exit(status)  # OGRE's objects have no order of destruction under Python


main()
