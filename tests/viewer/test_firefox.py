"""The essential tests of the page, in Firefox."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from . import firefox, test_browser, test_motions, test_program, test_saved_page

ESSENTIAL = [
    test_browser.test_shapes_appear_where_the_camera_sees_them_in_their_colors_and_sizes,
    test_browser.test_the_panda_is_seen_on_its_table,
    test_browser.test_the_arm_moves_with_the_joint_state,
    test_browser.test_frames_appear_change_and_disappear,
    test_browser.test_a_message_is_shown_as_text_until_it_is_replaced,
    test_browser.test_view_returns_the_key_that_was_pressed_on_the_page,
    test_browser.test_the_end_of_a_program_is_shown_and_the_page_reconnects,
    test_browser.test_a_token_may_be_given,
    test_browser.test_the_page_runs_no_foreign_script_and_loads_nothing,
    test_motions.test_a_path_is_played_and_can_be_looked_at_slice_by_slice,
    test_motions.test_the_time_slider_moves_everything,
    test_motions.test_a_saved_page_shows_the_motion_without_the_program,
    test_program.test_a_button_is_clicked_once_by_mouse_and_by_key,
    test_program.test_values_go_both_ways_and_lie_in_their_folders,
    test_program.test_drawings_are_seen_follow_frames_and_are_removed,
    test_program.test_a_click_on_the_scene_calls_the_program,
    test_saved_page.test_sliders_move_all_kinds_of_joints,
    test_saved_page.test_a_link_is_dragged_by_inverse_kinematics,
    test_saved_page.test_pages_run_the_script_that_they_share,
]
globals().update({test.__name__: test for test in ESSENTIAL})
panda, viewer = test_browser.panda, test_program.viewer


@pytest.fixture(scope="module")
def firefox_page() -> Iterator[firefox.Firefox]:
    if firefox.find() is None:
        pytest.skip(f"needs {' or '.join(firefox.NAMES)}, and {firefox.DISPLAY[0]}")
    with firefox.Firefox() as page:
        yield page


@pytest.fixture
def browser(firefox_page: firefox.Firefox) -> Iterator[firefox.Firefox]:
    """Firefox in place of Chromium; no script on the page may have thrown at the end."""
    firefox_page.errors.clear()
    yield firefox_page
    firefox_page.close_page()
    assert firefox_page.errors == []
