"""The problems of benchmarks/tool_paths.py, and their judge."""
