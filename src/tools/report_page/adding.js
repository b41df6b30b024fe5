// How to put the model to use: its file, and the commands.

function codeBlock(text) {
  const copy = element(
      'button', {
        type: 'button',
        onclick: () => navigator.clipboard.writeText(text).then(() => {
          copy.textContent = 'copied';
        })
      },
      'copy');
  return element('div', {class: 'code'}, element('pre', {}, text), navigator.clipboard ? copy : null);
}

function addingSection(findings) {
  const {model_file: file, commands} = findings.adding;
  return section(
      'adding', findings.after ? 'How to add it' : 'How to use the model',
      'The model as a file that monitor, simulator and command line load.', codeBlock(file),
      commands.map(({title, text}) => [element('h3', {}, title), codeBlock(text)]));
}
