"""The bill of materials of a wheel in the format CycloneDX 1.6: all software that it contains, with versions."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

LICENSES = {
    "cmeel-eigen": "MPL-2.0",
    "cmeel-assimp": "BSD-3-Clause",
    "cmeel-tinyxml2": "Zlib",
    "cmeel-boost": "BSL-1.0",
    "cmeel-qhull": "Qhull",
    "cmeel-zlib": "Zlib",
    "mujoco-core": "Apache-2.0",
    "nanobind": "BSD-3-Clause",
}


def bill_of_materials(root: Path) -> str:
    """Returns the text of the bill: the pinned build requirements that become part of the wheel, and the page's."""
    pyproject = tomllib.loads((root / "pyproject.toml").read_text())
    components = []
    for requirement in pyproject["build-system"]["requires"]:
        name, _, version = requirement.partition("==")
        name = name.split(">=")[0]
        if name in LICENSES:
            components.append(_component(f"pkg:pypi/{name}", name, version, LICENSES[name]))
    lock = json.loads((root / "viewer/package-lock.json").read_text())
    bundled = json.loads((root / "viewer/package.json").read_text()).get("dependencies", {})
    for name in sorted(bundled):
        package = lock["packages"][f"node_modules/{name}"]
        components.append(_component(f"pkg:npm/{name}", name, package["version"], package.get("license", "")))
    bill = {
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "version": 1,
        "metadata": {
            "component": {
                "type": "library",
                "name": "kinegraph",
                "version": pyproject["project"]["version"],
                "licenses": [{"license": {"id": "MIT"}}],
            }
        },
        "components": components,
    }
    return json.dumps(bill, indent=1) + "\n"


def _component(url: str, name: str, version: str, license_id: str) -> dict:
    component: dict = {"type": "library", "name": name, "purl": f"{url}@{version}" if version else url}
    if version:
        component["version"] = version
    if license_id:
        component["licenses"] = [{"license": {"id" if license_id != "Qhull" else "name": license_id}}]
    return component
