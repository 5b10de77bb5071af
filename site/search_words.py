"""Words that people search for, and where the answer is: the search of the site lists these places first."""

WORDS = {  # page, then heading (none for the page): words
    "install": {"": "install, pip, wheel"},
    "own_robot": {
        "": "own robot, urdf",
        "It collides right": "self collision",
        "It has a gripper": "gripper, fingers, mimic, suction cup",
    },
    "first_pick_and_place": {"": "pick and place"},
    "troubleshooting": {
        "Nothing moves": "nothing moves, object floats, arm sags",
        "There is no plan": "no plan, no plan found, invalid start",
        "A collision is not seen": "collision, contact",
        "Numbers look wrong": "degrees, radians, millimeters, wrong units",
        "Pictures without a display": "no display, headless, egl",
        "A remote machine": "ssh, remote, docker",
        "A notebook": "jupyter, colab",
        "A proxy": "proxy",
        "It is slow": "slow",
    },
    "conventions": {"Numbers": "units, quaternion order", "Grippers": "approach from above, gripper axes"},
    "errors": {"": "error, exception, warning"},
    "faq": {
        "Why are meshes with package:// not found?": "mesh not found",
        "How do I define a tool center point?": "tool center point, tcp",
        "How do I attach a grasped object?": "attach",
        "How does the control loop behave at a singularity?": "singularity",
        "Why does my object fall through the floor, or float?": "object falls, robot falls",
        "Does it use a GPU?": "gpu, cuda",
        "On which systems does it run?": "windows, macos",
    },
    "perception": {"": "camera, point cloud"},
    "speed": {"": "speed"},
    "ik": {"": "inverse kinematics"},
    "planning": {"": "motion planning, obstacles"},
    "timing": {"": "trajectory, retime, velocity limits, jerk"},
    "tasks": {"": "task planning, grasp"},
    "simulation": {"": "simulation, physics"},
    "control": {"": "control loop, joystick"},
    "viewer": {"Save what is shown": "save video, film, screenshot, save picture"},
    "ros2": {"": "ros, ros 2"},
    "cpp": {"": "c++, cmake, find_package"},
    "scenes": {"Limits": "joint limits"},
}


def withSearchWords(page: str, text: str) -> str:
    """Adds the entries of the index to a page.

    Args:
        page: Its name without suffix.
        text: Its text; headings must be those of the table.
    """
    for heading, words in WORDS.get(page, {}).items():
        entry = f"```{{index}} {', '.join(f'!{word}' for word in words.split(', '))}\n```\n\n"
        if not heading:
            text = entry + text
            continue
        start = next((k + 1 for level in ("## ", "### ") if (k := text.find(f"\n{level}{heading}\n")) >= 0), None)
        if start is None:
            raise SystemExit(f"site/search_words.py: {page}.md has no heading '{heading}'")
        text = text[:start] + entry + text[start:]
    return text
