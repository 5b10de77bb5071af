"""A live view of a robot in Foxglove."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from .._core import BotOp
from ..errors import Error
from .files import LATCHED
from .messages import definition, needed
from .recorder import Recorder, watchRobot


class FoxgloveServer:
    """A server to which Foxglove connects; `url` is its address."""

    def __init__(self, host: str, port: int, topics: Mapping[str, str]):
        """Starts the server.

        Args:
            host, port: See serveFoxglove.
            topics: Type of the messages of each topic.
        Raises:
            Error: The server does not start.
        """
        foxglove = needed("foxglove", "foxglove")
        context = self._context = foxglove.Context()
        self._channels: dict[str, Any] = {}
        for topic, kind in topics.items():
            schema = foxglove.Schema(name=kind, encoding="ros2msg", data=definition(kind).encode())
            self._channels[topic] = foxglove.Channel(topic, schema=schema, message_encoding="cdr", context=context)
        latched: dict[str, Any] = {}  # last message of topics whose late subscribers need it

        self._latched = latched

        class Listener(foxglove.websocket.ServerListener):  # type: ignore[misc, name-defined]
            def on_subscribe(self, client: Any, channel: Any) -> None:
                if channel.topic in latched:
                    send, data, time = latched[channel.topic]
                    send(data, log_time=time)

        try:
            self._server: Any = foxglove.start_server(
                name="kinegraph", host=host, port=port, context=context, server_listener=Listener()
            )
        except Exception as error:
            raise Error(f"serveFoxglove: no server at {host}:{port}: {error}") from None
        self.url = f"ws://{host}:{self._server.port}"

    def __repr__(self) -> str:
        return f"<FoxgloveServer {self.url}>"

    @property
    def closed(self) -> bool:
        """True after close."""
        return self._server is None

    def send(self, topic: str, kind: str, data: bytes, time: int) -> None:
        """Sends a message to all clients that subscribe to its topic."""
        channel = self._channels[topic]
        if topic in LATCHED:
            self._latched[topic] = (channel.log, data, time)
        channel.log(data, log_time=time)

    def close(self) -> None:
        """Ends the server."""
        server, self._server = self._server, None
        if server is not None:
            server.stop()


def serveFoxglove(
    bot: BotOp,
    *,
    host: str = "127.0.0.1",
    port: int = 8765,
    rate: float = 50.0,
    cameras: Sequence[str] = (),
    camera_rate: float = 10.0,
    start: float = 0.0,
) -> FoxgloveServer:
    """Shows a robot live in Foxglove, while calls wait, with the topics of `bot.recordTo`.

    Open a connection to the server's `url` there. `server.close()` ends it.

    Args:
        bot: The robot.
        host: Address on which the server listens; the default accepts programs of this machine only.
        port: Port; 0 takes a free one.
        rate: Samples per second, Hz.
        cameras: Camera frames whose images are shown.
        camera_rate: Images per second, Hz.
        start: Unix time of control time 0, s.
    Returns:
        The server.
    Raises:
        ArgumentError: A number is invalid.
        FrameNotFound: There is no such camera.
        NotFound: The packages of the extras `mcap` and `foxglove` are not installed.
        Error: The server does not start, for instance because the port is in use.
    """
    recorder = Recorder("serveFoxglove", rate, cameras, camera_rate, start)
    for name in recorder.cameras:
        bot.getCameraFxycxy(name)
    server = FoxgloveServer(host, port, recorder.topics())
    recorder.open(server)
    watchRobot(bot, recorder)
    return server
