"""Saved pages of the viewer that share one script, instead of one copy each."""

import gzip
import re
from base64 import b64decode
from pathlib import Path

PACKED = re.compile(r'<script type="text/plain" id="client">(?P<data>[^<]*)</script>\s*<script>.*?</script>', re.DOTALL)
POLICY = re.compile(r"script-src [^;\"]*")


def shareClient(page: str, script: Path, source: str) -> str:
    """Returns the page with a reference to the script, which is written if it is not there yet.

    Args:
        page: A page saved by the viewer, which contains its client compressed.
        script: File of the script. Pages of another client than the file's are refused.
        source: Its address relative to the page.
    """
    packed = PACKED.search(page)
    assert packed, "a saved page contains its compressed client"
    text = gzip.decompress(b64decode(packed["data"])).decode()
    if not script.exists():
        script.write_text(text)
    elif script.read_text() != text:
        raise ValueError(f"{script} is the script of another client; delete the cache of the scenes")
    reference = f'<script src="{source}"></script>'
    return POLICY.sub("script-src 'self' file:", page[: packed.start()] + reference + page[packed.end() :], count=1)
