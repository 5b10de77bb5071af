"""Pairs of parts of a robot that can collide."""

import re
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry
from kinegraph.cli import main


def configurations(C: ry.Config, count: int, seed: int) -> np.ndarray:
    low, high = C.getJointLimits()
    return low + np.random.default_rng(seed).random((count, len(low))) * (high - low)


@pytest.fixture
def arm() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("panda/panda.g"))
    return C


def test_reasons_agree_with_samples_of_another_generator(arm):
    matrix = arm.selfCollisionMatrix(samples=4000, root=arm.getFrameNames()[0])
    assert matrix.samples == 4000 and len(matrix) == len(matrix.pairs)
    kinds = {reason for _, _, reason, _ in matrix.pairs}
    assert "never" in kinds and "sometimes" in kinds and kinds <= {"adjacent", "always", "never", "sometimes"}
    owner = {f.name: (f.getParent().name if f.getParent() and f.getJointType() == ry.JT.none else f.name) for f in arm}
    count: dict[tuple[str, str], int] = {}
    Q = configurations(arm, 1500, 7)
    for q in Q:
        arm.setJointState(q)
        for pair in {tuple(sorted((owner[a], owner[b]))) for a, b, _ in arm.getCollisions()}:
            count[pair] = count.get(pair, 0) + 1
    for a, b, reason, share in matrix.pairs:
        seen = count.get(tuple(sorted((a, b))), 0) / len(Q)
        assert seen == pytest.approx(share, abs=5 * np.sqrt(share / len(Q)) + 3e-3), (a, b)
        if reason == "never":
            assert share == 0


def test_the_remaining_pairs_give_the_same_verdicts(arm):
    Q = configurations(arm, 3000, 1)
    before = arm.isValid(Q)
    pairs = len(arm.getCollidablePairs())
    matrix = arm.selfCollisionMatrix(root=arm.getFrameNames()[0], apply=True)
    assert all(reason != "always" for _, _, reason, _ in matrix.pairs)
    assert len(arm.getCollidablePairs()) < pairs
    assert (arm.isValid(Q) == before).mean() > 0.998


def test_the_answer_depends_on_the_seed_alone(arm):
    first = arm.selfCollisionMatrix(samples=500, seed=3)
    assert first.pairs == arm.selfCollisionMatrix(samples=500, seed=3, threads=3).pairs
    assert first.pairs != arm.selfCollisionMatrix(samples=500, seed=4).pairs


def test_srdf_has_what_is_ignored(tmp_path: Path):
    link = '<collision><geometry><sphere radius="{}"/></geometry></collision>'
    names = ["base", "upper", "elbow", "lower", "tip"]
    links = "".join(f'<link name="{name}">{link.format(0.1)}</link>' for name in names)
    joints = "".join(
        f'<joint name="j{i}" type="revolute"><parent link="{a}"/><child link="{b}"/><origin xyz="0 0 {z}"/>'
        '<axis xyz="1 0 0"/><limit lower="-2" upper="2" effort="1" velocity="1"/></joint>'
        for i, (a, b, z) in enumerate(zip(names, names[1:], (0.3, 0.05, 0.5, 0.4), strict=False))
    )
    file = tmp_path / "arm.urdf"
    file.write_text(f'<robot name="arm">{links}{joints}</robot>')
    (tmp_path / "arm.srdf").write_text('<robot name="arm"><enable_collisions link1="base" link2="upper"/></robot>')
    C = ry.Config()
    C.addFile(str(file))
    matrix = C.selfCollisionMatrix(root="base", samples=500, apply=True)
    text = C.asSRDF()
    assert [reason for _, _, reason, _ in matrix.pairs].count("adjacent") == 4 == text.count('reason="Adjacent"')
    told = {frozenset(pair) for pair in re.findall(r'<disable_collisions link1="(\w+)" link2="(\w+)"', text)}
    assert told == {frozenset((a, b)) for a, b, reason, _ in matrix.pairs if reason != "sometimes"}
    assert 4 < len(told) < len(matrix)


def test_pairs_left_out_by_the_rule_of_the_scene_are_not_told_to_collide_never():
    C = ry.Config()
    C.addText("""base: { shape: sphere, size: [.1], contact: 1 }
a (base): { joint: hingeX, pre: [0 0 .3], shape: sphere, size: [.1], contact: -3 }
b (a): { joint: hingeX, pre: [0 0 .3], shape: sphere, size: [.1], contact: -3 }
c (b): { joint: hingeX, pre: [0 0 .3], shape: sphere, size: [.1], contact: -3 }
d (c): { joint: hingeX, pre: [0 0 .3], shape: sphere, size: [.1], contact: -3 }""")
    C.selfCollisionMatrix(root="base", samples=200, apply=True)
    pairs = re.findall(r'link1="(\w+)" link2="(\w+)" reason="(\w+)"', C.asSRDF())
    reasons = {(a, b): reason for a, b, reason in pairs}
    assert reasons["b_link", "d_link"] == reasons["a_link", "c_link"] == "User"
    assert reasons["a_link", "b_link"] == "Adjacent" and "Never" not in reasons.values()


def test_the_command_prints_and_writes(tmp_path: Path, capsys):
    out = tmp_path / "panda.srdf"
    assert main(["selfcollisions", ry.raiPath("panda/panda.g"), "--samples", "200", "-o", str(out)]) == 0
    printed = capsys.readouterr().out
    assert "never" in printed and "SelfCollisionMatrix" in printed and "<disable_collisions" in out.read_text()


def test_invalid_arguments_are_errors(arm):
    with pytest.raises(ry.FrameNotFound, match="similar names"):
        arm.selfCollisionMatrix(root="panda_bas")
    with pytest.raises(ry.ArgumentError, match="samples is 0"):
        arm.selfCollisionMatrix(samples=0)
    with pytest.raises(ry.ArgumentError, match="has no collidable pair of shapes"):
        ry.Config().selfCollisionMatrix()
