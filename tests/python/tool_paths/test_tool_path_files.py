"""Tool paths from tables and from programs of G-code."""

import numpy as np
import pytest

import kinegraph as ry
from tool_motion import LIMITS, distance_from_line, poses, samples


def test_rows_are_read_from_a_file(scene, tmp_path):
    start = scene.getFrame("tool").getPosition()
    rows = start + np.linspace(0, 0.1, 101)[:, None] * [0, 1, 0]
    file = tmp_path / "seam.csv"
    file.write_text("x, y, z\n# a comment\n" + "\n".join(",".join(map(repr, map(float, row))) for row in rows))
    plan = ry.planToolPath(scene, ry.ToolPath.read(file, frame="tool"), speed=0.1)
    assert plan, plan.message
    x = poses(scene, samples(plan)[1])[:, :3]
    assert distance_from_line(x, rows[0], rows[-1]).max() <= 2e-5
    file.write_text("0,0,0\n0,0,a\n")
    with pytest.raises(ry.ParseError, match=r"seam.csv:2:5: 'a' is not a number"):
        ry.ToolPath.read(file)
    with pytest.raises(ry.FileError, match="nothing.csv"):
        ry.ToolPath.read(tmp_path / "nothing.csv")


ROWS = np.c_[np.linspace([0.0, 0.3, 0.85], [0.1, 0.3, 0.85], 11), np.tile([0.0, 0.0, 1.0], (11, 1))]
POSES = np.c_[ROWS[:, :3], np.tile([1.0, 0, 0, 0], (11, 1))]  # x y z qw qx qy qz


def table(rows, separator=","):
    return "\n".join(separator.join(map(repr, map(float, row))) for row in rows)


@pytest.mark.parametrize(
    "text",
    [
        "\ufeff" + table(ROWS),  # with the byte order mark of spreadsheets
        '\ufeff"X";"Y";"Z";"NX";"NY";"NZ"\r\n' + table(ROWS, ";").replace("\n", "\r\n"),
        "nx,ny,nz,x,y,z\n" + table(ROWS[:, [3, 4, 5, 0, 1, 2]]),
        "x y z qx qy qz qw\n" + table(POSES[:, [0, 1, 2, 4, 5, 6, 3]], " "),  # as ROS has it
        "point on the seam\n" + table(ROWS, "\t").replace("\n", "  # a comment\n"),
        table(ROWS).replace("\n", ",\n"),
        "X [mm],Y [mm],Z [mm],nx,ny,nz\n" + table(ROWS * [1e3, 1e3, 1e3, 1, 1, 1]),
        "x_cm;y_cm;z_cm;nx;ny;nz\n" + table(ROWS * [1e2, 1e2, 1e2, 1, 1, 1], ";"),
        "id,x,y,z,note,nx,ny,nz\n"
        + "\n".join(f"{k}," + table([r[:3]]) + ",ok," + table([r[3:]]) for k, r in enumerate(ROWS)),
        "x,y,z,nx,ny,nz\n" + "\n".join(",".join(f'"{value}"' for value in row) for row in ROWS),
    ],
)
def test_rows_of_many_tables_are_the_same(scene, tmp_path, text):
    file = tmp_path / "seam.csv"
    file.write_bytes(text.encode("utf-16") if "qx" in text else text.encode())
    path = ry.ToolPath.read(file).free()
    plan = ry.planToolPath(scene, path, speed=0.1)
    assert plan, plan.message
    x = poses(scene, plan.eval(np.array([0.0, plan.duration]))[0])
    np.testing.assert_allclose(x[:, :3], ROWS[[0, -1], :3], atol=3e-5)
    z = scene.evalBatch(ry.FS.vectorZ, ["tool"], plan.eval(np.array([0.0]))[0])[0]
    np.testing.assert_allclose(z, [[0, 0, 1]], atol=1e-4)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("0.1,0.2,O.3\n0,0,0\n0,0,1\n", r"1:9: 'O.3' is not a number"),  # a letter, and no column name
        ("0,4;0,1;0,15\n0,5;0,1;0,15\n", r"1:2: the row has commas and semicolons"),
        ("0,5\t0,2\t0,1\n0,5\t0,2\t0,2\n", r"1:5: the field has two numbers"),
        ("0,5 0,2 0,1\n0,5 0,2 0,2\n", r"1:5: the field has two numbers"),
        ("0,0,0\n0,,1\n", r"2:3: the field is empty"),
        ('"0.1","0","0"\n"0.1","","0.3"\n', r"2:7: the field is empty"),
        ('x,y,z\n"0.1","","0.3"\n', r"2:7: the field is empty"),
        ("note,x,y,z\nseam,0.1,,0.3\n", r"2:10: the field is empty"),
        ("note,x,y,z\nseam,0.1 0.2,0,0.3\n", r"2:6: '0.1 0.2' is not a number"),
        ("x,y,z\n0,0,0,,\n", r"2:8: the row has 5 fields; there are 3 names"),
        ("x,y,z,rx,ry,rz\n0,0,0,0,0,0\n", r"1:7: the column 'rx' is an angle; expected a normal"),
        ("x,y,z\n0,0,0,1\n0,0,1,1\n", r"2:7: the row has 4 fields; there are 3 names"),
        ("x,y,z,qx,qy,qz,qz\n0,0,0,0,0,0,1\n", r"1:7: expected each of the columns qw, qx, qy, qz once"),
        ("x,x,z\n0,0,0\n0,0,1\n", r"1:1: the names of the columns are not x y z"),
        ("x_mm,y_m,z_mm\n0,0,0\n0,0,1\n", r"1:6: x, y and z have different units"),
        ("z,y,x\n0,0,0,0,0,1\n", r"2:11: the row has 6 fields; there are 3 names"),
        ("id,x,y,z\n1,0,0,0\n2,0,0,O\n", r"3:7: 'O' is not a number"),
        ("0,0,0,0,0,1\n0,0,1,0,0,0\n", r"2:7: the normal is zero"),
        ("qw,qx,qy,qz,x,y,z\n0,0,0,0,0,0,1\n", r"2:1: the quaternion is zero"),
        ("nan,nan,nan\n0,0,0\n0,0,1\n", r"1:1: 'nan' is not a number"),
    ],
)
def test_tables_that_are_not_read_are_explained(tmp_path, text, message):
    file = tmp_path / "seam.csv"
    file.write_text(text)
    with pytest.raises(ry.ParseError, match=r"seam\.csv:" + message):
        ry.ToolPath.read(file)


def test_other_columns_are_ignored_with_a_warning(tmp_path):
    file = tmp_path / "seam.csv"
    file.write_text("id, x, y, z\n1,0,0,0\n2,0,0,1\n")
    assert ry.ToolPath.read(file).warnings == [f"{file}:1:1: the column 'id' is ignored"]


@pytest.mark.parametrize(
    "text",
    [
        "note,x,y,z,comment\nseg 1,0.1,0.2,0.3,\nseg 2,0.4,0.5,0.6,ok\n",
        "note;x;y;z;comment\n;0.1;0.2;0.3;\nseg 2;0.4;0.5;0.6;7, 8;\n",
        "note\tX [m]\tY [m]\tZ [m]\nseg 1\t0.1\t0.2\t0.3\n\t0.4\t0.5\t0.6\t\n",
        ",x,y,z\n0,0.1,0.2,0.3\n1,0.4,0.5,0.6\n,,,\n",
        '"a, b",x,y,z,\n"1, 2",0.1,0.2,0.3,\n"",0.4,0.5,0.6\n',
        "seam 1, left\n0.1,0.2,0.3\n0.4,0.5,0.6\n",
        "x y z\n0.1,0.2,0.3\n0.4\t0.5\t0.6\n",
    ],
)
def test_columns_are_split_at_the_separator_of_their_names(tmp_path, text):
    file = tmp_path / "seam.csv"
    file.write_text(text)
    first, elements = ry.ToolPath.read(file).__getstate__()[2:4]
    np.testing.assert_allclose([first[:3], elements[-1][1][-1][:3]], [[0.1, 0.2, 0.3], [0.4, 0.5, 0.6]])


def test_a_column_without_a_name_is_ignored_with_a_warning(tmp_path):
    file = tmp_path / "seam.csv"
    file.write_text(",x,y,z\n0,0,0,0\n1,0,0,1\n")
    assert ry.ToolPath.read(file).warnings == [f"{file}:1:1: a column without a name is ignored"]


def test_the_extruder_of_a_printer_is_ignored(tmp_path):
    file = tmp_path / "part.gcode"
    file.write_text("G92 E0\nG0 X0 Y0 Z0\nG1 X10 E1 F600\n")
    assert ry.ToolPath.read(file).warnings == [
        f"{file}:1:1: G92 is ignored",
        f"{file}:1:5: E0 is ignored",
        f"{file}:3:8: E1 is ignored",
    ]
    for line in ("G92 X0", "G92", "G92 E0 Z0"):  # they move the origin
        file.write_text(f"{line}\nG0 X0 Y0 Z0\nG1 X10\n")
        with pytest.raises(ry.ParseError, match="1:1: unknown code G92"):
            ry.ToolPath.read(file)


def test_coordinates_in_millimeters_are_asked_for(scene, tmp_path):
    file = tmp_path / "seam.csv"
    position = scene.getFrame("tool").getPosition()
    file.write_text(table([position, 1000 * position + 1]))  # the path begins within reach
    plan = ry.planToolPath(scene, ry.ToolPath.read(file))
    assert "did you mean meters? " in plan.message


def test_a_program_of_gcode_is_cut_at_its_feeds(scene, tmp_path):
    C = scene
    C.addFrame("work", "table").setRelativePosition([0, 0.35, 0.15])
    file = tmp_path / "slot.nc"
    file.write_text(
        "(a slot) G21 G90\nG0 X-40 Y0 Z20\nG1 Z0 F1200\nG1 X40 F6000\nG3 X40 Y20 J10\nG1 X-40\nG3 Y0 J-10\nM5\nM30\n"
    )
    path = ry.ToolPath.read(file, relativeTo="work").free()
    assert path.warnings == [f"{file}:8:1: M5 is ignored"]
    plan = ry.planToolPath(C, path, speed=0.3, **LIMITS)
    assert plan, plan.message
    t, q = samples(plan)
    p = poses(C, q)[:, :3] - C.getFrame("work").getPosition()
    way = np.array([plan.way(time)[1] for time in t])
    speed = np.linalg.norm(np.diff(p, axis=0), axis=1) / t[1]
    plunge = way[1:] < 0.02 - 1e-4
    assert speed[plunge].max() <= 0.02 * 1.001
    assert speed.max() <= 0.1 * 1.001
    on_slot = p[way > 0.0201]
    straight = np.abs(on_slot[:, 0]) <= 0.04
    assert np.minimum(np.abs(on_slot[straight, 1]), np.abs(on_slot[straight, 1] - 0.02)).max() < 2.1e-5
    round = on_slot[~straight, :2] - np.c_[np.sign(on_slot[~straight, 0]) * 0.04, np.full(np.sum(~straight), 0.01)]
    assert np.abs(np.linalg.norm(round, axis=1) - 0.01).max() < 2.1e-5
    file.write_text("G0 X0 Y0 Z0\nG1 X5 Q3\nG83 Z1\n")
    with pytest.raises(ry.errors.ParseError, match=r"slot\.nc:3:1: unknown code G83"):
        ry.ToolPath.readGcode(file)
