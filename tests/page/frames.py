"""The frames of `signorini paraview`, read by VTK; and a picture of one, where VTK can draw.

frames.py DIR/paraview/run.pvd [PICTURE]
"""
import pathlib
import sys
import xml.etree.ElementTree as tree

import vtk

pvd = pathlib.Path(sys.argv[1])
frames = [(float(item.get("timestep")), pvd.parent / item.get("file")) for item in tree.parse(pvd).iter("DataSet")]
times = [t for t, _ in frames]
assert times == sorted(set(times)) and times[0] == 0.0, times[:5]


def read(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


for _, path in frames:
    grid = read(path)
    assert grid.GetNumberOfPoints() > 0 and grid.GetNumberOfCells() > 0, path
    for name in ("displacement", "force"):
        assert grid.GetPointData().GetArray(name).GetNumberOfComponents() == 3, path
    for name in ("kind", "state", "item"):
        assert grid.GetCellData().GetArray(name).GetNumberOfTuples() == grid.GetNumberOfCells(), path
print(f"{len(frames)} frames, the last at {times[-1]}")

if len(sys.argv) > 2:
    grid = read(frames[len(frames) // 4][1])
    grid.GetPointData().SetActiveVectors("displacement")
    warp = vtk.vtkWarpVector()
    warp.SetInputData(grid)
    warp.SetScaleFactor(50.0)
    structure = vtk.vtkDataSetMapper()
    structure.SetInputConnection(warp.GetOutputPort())
    structure.SetScalarModeToUseCellFieldData()
    structure.SelectColorArray("state")
    structure.SetScalarRange(-1, 4)
    forces = vtk.vtkGlyph3D()
    arrow = vtk.vtkArrowSource()
    forces.SetSourceConnection(arrow.GetOutputPort())
    warp.Update()
    warp.GetOutput().GetPointData().SetActiveVectors("force")
    forces.SetInputData(warp.GetOutput())
    forces.SetVectorModeToUseVector()
    forces.SetScaleModeToScaleByVector()
    forces.SetScaleFactor(0.03)
    glyphs = vtk.vtkPolyDataMapper()
    glyphs.SetInputConnection(forces.GetOutputPort())
    glyphs.ScalarVisibilityOff()
    scene = vtk.vtkRenderer()
    scene.SetBackground(1, 1, 1)
    for mapper, colour in ((structure, (0, 0, 0)), (glyphs, (0.75, 0.1, 0.17))):
        actor = vtk.vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(*colour)
        actor.GetProperty().SetLineWidth(3)
        actor.GetProperty().SetPointSize(9)
        scene.AddActor(actor)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetSize(900, 500)
    window.AddRenderer(scene)
    window.Render()
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(sys.argv[2])
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()
