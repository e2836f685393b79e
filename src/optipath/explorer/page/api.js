/** Questions to the server: one at a time, and of those that wait the newest. */

/** @param {string} route @returns {Promise<any>} */
export async function get(route) {
  return answerOf(fetch(`api/${route}`));
}

/** @param {string} route @param {object} body @returns {Promise<any>} */
export async function post(route, body) {
  return answerOf(
    fetch(`api/${route}`, {
      method: "POST",
      headers: { "Content-Type": "application/json" },
      body: JSON.stringify(body),
    }),
  );
}

/** An answer always; where something went wrong, its `faults` say what. */
async function answerOf(asked) {
  let response;
  try {
    response = await asked;
  } catch {
    return failed("The program that serves this page does not answer; start it again.");
  }
  try {
    const answer = await response.json();
    return answer.error === undefined ? answer : failed(answer.error);
  } catch {
    return failed(`The program that serves this page answered with status ${response.status}.`);
  }
}

const failed = (sentence) => ({ faults: [{ field: null, sentence }] });

/**
 * A function that asks, skipping what has been overtaken while an answer was awaited.
 *
 * @template Q, A
 * @param {(question: Q) => Promise<A>} ask
 * @param {(question: Q, answer: A) => void} show called for each answer, in order
 * @returns {(question: Q) => Promise<void>}
 */
export function newest(ask, show) {
  let busy = false;
  let waiting = null;
  return async (question) => {
    waiting = { question };
    if (busy) return;
    busy = true;
    try {
      while (waiting !== null) {
        const now = waiting.question;
        waiting = null;
        const answer = await ask(now);
        show(now, answer);
      }
    } finally {
      busy = false;
    }
  };
}
