"""Settings of Sphinx. site/build.py collects the pages and calls it."""

import os
import sys

project, author = "Kinegraph", "The Kinegraph authors"
copyright = "2026, the Kinegraph authors"
release = version = os.environ["KINEGRAPH_VERSION"]
sys.path.append(os.environ["KINEGRAPH_SITE"])
extensions = ["myst_parser", "breathe", "sphinx_design", "sphinx_copybutton", "mathml"]
html_math_renderer = "mathml"
myst_enable_extensions = ["colon_fence", "fieldlist", "deflist", "attrs_inline", "dollarmath"]
myst_heading_anchors = 4
breathe_projects = {"kinegraph": os.environ["KINEGRAPH_DOXYGEN"]}
breathe_default_project = "kinegraph"
breathe_show_include = True
html_theme = "pydata_sphinx_theme"
html_title = "Kinegraph"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_sidebars = {page: [] for page in ("install", "changes", "gallery/index")}  # pages without others beside them
html_extra_path = ["_extra"]
html_theme_options = {
    "header_links_before_dropdown": 7,
    "show_toc_level": 2,
    "navigation_with_keys": True,
    "navbar_align": "left",
    "show_prev_next": True,
}
html_show_sourcelink = False
python_use_unqualified_type_names = True
add_module_names = False
toc_object_entries_show_parents = "hide"
python_maximum_signature_line_length = 88
cpp_maximum_signature_line_length = 88
copybutton_prompt_text = r">>> |\$ "
copybutton_prompt_is_regexp = True
nitpicky = False
suppress_warnings = ["misc.highlighting_failure", "ref.python"]  # several classes have a member C
