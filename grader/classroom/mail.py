"""Write mails to students who must send work again: drafts, and a list for mail merge.

Nothing is sent: an EML file with `X-Unsent: 1` opens as a draft in the instructor's mail program.
A draft that a person edited is never replaced or removed.
"""

import hashlib
from collections.abc import Iterator
from email import message_from_bytes
from email.message import EmailMessage
from email.policy import SMTP, SMTPUTF8
from pathlib import Path

from grader.classroom.adjustments import Adjustments
from grader.classroom.book import NOTHING, Outcome
from grader.classroom.feedback import Feedback, find_address_column
from grader.classroom.owners import find_owners
from grader.errors import Stop
from grader.intake.names import make_portable
from grader.intake.roster import Roster, list_full_names
from grader.text import clean, format_csv

DRAFTS = "mail"  # the folder of drafts
DIGEST = "X-Written"  # the digest of a draft as it was written
ASKS = {  # the request by a part of the reason; the first match counts
    "encrypted": "Your archive has a password. Please send it again without one.",
    "more than one program": "Your submission holds two versions of one file: {reason}. "
    "Please send it again with the one that counts.",
    "handed in more than once": "You handed in more than one version: {reason}. "
    "Please send one submission, with the work that counts.",
    "needed in UTF-8": "One of your files is not saved as UTF-8, so Python cannot read "
    "it: {reason}. Please save it as UTF-8 and send your work again.",
    "a text or a link": "A text or a link came from you, and no file. "
    "Please send your files in a zip.",
    "nothing of the lab": "None of the lab's files were in what you sent: {reason}. "
    "Please send the whole folder of the lab in a zip.",
    "packed in": "Your archive cannot be opened here: {reason}. Please send a zip.",
    "cut off": "Your archive is empty or incomplete. Please make it anew and send it again.",
    "broken": "Your archive is broken. Please make it anew and send it again.",
    "too large": "Your archive is too large: {reason}. Please send the lab's files alone.",
    "empty": "Your files are empty: {reason}. Please send the ones with your work.",
}
OTHERWISE = "Your work could not be graded: {reason}. Please send it again in a zip."


def write_body(name: str, reason: str, title: str) -> str:
    """Return the request to a student whose work could not be graded."""
    ask = next((words for sign, words in ASKS.items() if sign in reason), OTHERWISE)
    ask = ask.format(reason=clean(reason).rstrip("."))
    greeting = f"Hello {name}," if name else "Hello,"
    words = f"your submission of “{title}” has no points yet."
    return f"{greeting}\n\n{words} {ask}\n\nThank you.\n"


def find_decided(outcomes: list[Outcome], adjustments: Adjustments) -> Iterator[Outcome]:
    """Yield students without a mark who have a decision newer than the grades."""
    for each in outcomes:
        chosen = [one for one in adjustments.adjust if one.points is not None or one.take]
        reasons = [one.reason for one in chosen if one.concerns(each.name)]
        counted = "; ".join(each.reasons)
        if each.mark is None and any(reason not in counted for reason in reasons):
            yield each


def write_mail(roster: Roster, key: str, outcomes: list[Outcome], title: str) -> Feedback:
    """Return each needed draft, and `mail.csv`, by file name.

    Students without an address get a note.
    """
    made, column = Feedback(), find_address_column(roster)
    subject = clean(f"{title}: please send your work again")
    table = [["address", "name", "subject", "text"]]
    absent = [each.name for each in outcomes if each.trouble == NOTHING]
    owners = find_owners(roster, key, [each.name for each in outcomes], absent)
    for each in outcomes:
        if each.mark is not None or each.trouble == NOTHING:
            continue
        rows = [row for row in roster.rows if each.name in owners.find_results(row)]
        addressed = [row for row in rows if "@" in row[column]]
        if not addressed:
            made.notes.append(f"{each.label}: no mail, the class list has no address for that name")
        for row in addressed:
            name, address = clean(next(list_full_names(row), "")), " ".join(row[column].split())
            body = write_body(name, each.trouble, title)
            try:
                draft = make_draft(address, subject, body)
            except ValueError as error:  # a line break or another sign that is invalid in addresses
                raise Stop(f"{roster.path} has {address!r}, which is no address") from error
            made.files[f"{DRAFTS}/{make_portable(address)}.eml"] = draft
            table.append([address, name, subject, body])
    made.files["mail.csv"] = format_csv(table).encode("utf-8-sig")
    return made


def make_draft(address: str, subject: str, body: str) -> bytes:
    """Return a mail without a sender or date, which mail programs open as a draft."""
    message = EmailMessage(policy=SMTP if address.isascii() else SMTPUTF8)
    message["To"] = address
    message["Subject"] = subject
    message["X-Unsent"] = "1"
    message.set_content(body)
    message[DIGEST] = digest(message.as_bytes())
    return message.as_bytes()


def digest(draft: bytes) -> str:
    """Return a digest of the words of a draft."""
    mail = message_from_bytes(draft, policy=SMTP)
    read = f"{mail['To']}\n{mail['Subject']}\n{mail.get_content()}"
    return hashlib.sha256(read.encode()).hexdigest()[:16]


def is_unedited(draft: bytes) -> bool:
    try:
        return str(message_from_bytes(draft, policy=SMTP)[DIGEST]) == digest(draft)
    except (LookupError, ValueError):  # an attachment, or no mail
        return False


def keep_edited(folder: Path, made: Feedback) -> None:
    """Remove earlier drafts; keep edited ones instead of their new versions."""
    for path in sorted((folder / DRAFTS).glob("*.eml")):
        if is_unedited(path.read_bytes()):
            path.unlink()
            continue
        why = "to have a new one, remove it"
        if made.files.pop(f"{DRAFTS}/{path.name}", None) is None:
            why = "its student needs none now"
        made.notes.append(f"{path} is not as it was written, and stays: {why}")
