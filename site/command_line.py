"""Writes the page of the command line, from its own parser."""

import argparse
from pathlib import Path

from kinegraph import cli


def subcommands(parser: argparse.ArgumentParser) -> dict[str, tuple[str, argparse.ArgumentParser]]:
    """Names of the commands with their help and their parsers."""
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            texts = {choice.dest: choice.help or "" for choice in action._choices_actions}
            return {name: (texts.get(name, ""), command) for name, command in action.choices.items()}
    return {}


def argumentRow(action: argparse.Action) -> str:
    if action.option_strings:
        name = ", ".join(f"`{option}`" for option in action.option_strings)
        if action.nargs != 0:
            name += f" `{action.metavar or action.dest.upper()}`"
    else:
        name = f"`{action.metavar or action.dest}`"
    text = (action.help or "").replace("|", "\\|")
    if action.choices:
        text += f" One of {', '.join(f'`{choice}`' for choice in action.choices)}."
    return f"| {name} | {text % {'default': action.default, 'prog': 'kinegraph'} if '%(' in text else text} |"


def writePage(file: Path) -> None:
    lines = ["# Command line", "", "`kinegraph COMMAND --help` prints the same in a terminal.", ""]
    for name, (text, parser) in subcommands(cli._parser()).items():
        lines += [f"## kinegraph {name}", "", text[:1].upper() + text[1:] + ("" if text.endswith(".") else "."), ""]
        actions = [action for action in parser._actions if not isinstance(action, argparse._HelpAction)]
        if actions:
            lines += ["| argument | meaning |", "|---|---|", *map(argumentRow, actions), ""]
    file.write_text("\n".join(lines))
