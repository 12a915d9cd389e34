"""List all cases of *predict a number*. Students do not get their code: see practice.py."""

from grader.questions import cases_of_contacts, cases_of_integrators, cases_of_time

MAKERS = (*cases_of_contacts.MAKERS, *cases_of_time.MAKERS, *cases_of_integrators.MAKERS)
