"""Fixtures for the tests in a browser."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

import kinegraph as kg

from . import browser as chromium
from .program import KinematicModel


@pytest.fixture(scope="session")
def session_browser() -> Iterator[chromium.Browser]:
    if chromium.find() is None:
        pytest.skip(f"none of these is installed: {', '.join(chromium.NAMES)}")
    with chromium.Browser() as page:
        yield page


@pytest.fixture
def browser(session_browser: chromium.Browser) -> Iterator[chromium.Browser]:
    """The browser; no script on the page may have thrown at the end."""
    session_browser.errors.clear()
    yield session_browser
    session_browser.close_page()
    assert session_browser.errors == []


@pytest.fixture
def config() -> Iterator[kg.Config]:
    """A configuration whose viewer ends with the test."""
    config = kg.Config()
    yield config
    config.view_close()


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Callable[..., KinematicModel]]:
    """Starts Python programs; those that still run at the end are killed."""
    programs: list[KinematicModel] = []

    def start_program(code: str, **environment: str) -> KinematicModel:
        programs.append(KinematicModel(code, tmp_path, environment))
        return programs[-1]

    yield start_program
    for program in programs:
        program.kill()
