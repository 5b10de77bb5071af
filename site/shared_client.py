"""Saved pages of the viewer that share one script, instead of one copy each."""

import re
import zlib
from base64 import b64decode
from pathlib import Path

from kinegraph.embedded_page import embeddedPage

PACKED = re.compile(r'<script type="text/plain" id="client">(?P<data>[^<]*)</script>\s*<script>.*?</script>', re.DOTALL)
LAST = re.compile(r"(?s).*<script>(?P<text>.*?)</script>")
POLICY = re.compile(r"script-src [^;\"]*")


def shareClient(page: str, script: Path, source: str) -> str:
    """Returns the page with packed messages and a reference to the script, which is written if it is not there yet.

    Args:
        page: A page saved by the viewer.
        script: File of the script. Pages of another client than the file's are refused.
        source: Its address relative to the page.
    """
    packed = PACKED.search(page)
    if packed:
        text = zlib.decompress(b64decode(packed["data"])).decode()
    else:
        last = LAST.match(page)
        assert last, "a saved page ends with the script of the client"
        text = last["text"]
    if not script.exists():
        script.write_text(text)
    elif script.read_text() != text:
        raise ValueError(f"{script} is the script of another client; delete the cache of the scenes")
    small = embeddedPage(page, largest=10**9)  # packs, and keeps all vertices
    reference = f'<script src="{source}"></script>'
    found = PACKED.search(small)
    assert found, "embeddedPage packs the client"
    return POLICY.sub("script-src 'self' file:", small[: found.start()] + reference + small[found.end() :], count=1)
