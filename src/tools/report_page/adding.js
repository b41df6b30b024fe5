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

/** A word as a shell takes it. */
const shellQuoted = word => (/^[\w./:+=,@%-]+$/.test(word) ? word : `'${word.replaceAll('\'', '\'\\\'\'')}'`);

/** The request of ~set_effects for the forces of the model; empty: it has none. */
function effectsRequest({parameters, effects}) {
  const forces = parameters.filter(({effect}) => effect && effects[effect].kind === 'force');
  const isShape = ({name, effect}) => name !== effect;
  const shapes = forces.filter(isShape);
  const list = words => `[${words.join(', ')}]`;
  const names = list(forces.filter(each => !isShape(each)).map(({name}) => name));
  return forces.length ? `{names: ${names}, shape_names: ${list(shapes.map(({name}) => name))}, shape_values: ${
                             list(shapes.map(({value}) => Number(value.toPrecision(6))))}}` :
                         '';
}

/** The options of a command that say what is read, and how: every command on such bags needs them. */
const optionsOfReading = command =>
    (command.match(/ --(config|set|sprung-topic|unsprung-topic)[ =]('[^']*'|\S+)/g) || []).join('');

/** A file, as a shell takes it, for roslaunch. */
const fromAnywhere = path => (/^'?\//.test(path) ? path : `$PWD/${path}`);

/** What to type: title and text. */
function commandsOf(findings) {
  const {vehicle, bags, origin} = findings;
  const given = optionsOfReading(origin.command);
  const [, config] = given.match(/ --config[ =]('[^']*'|\S+)/) || [];
  const settings = config ? ` config:=${fromAnywhere(config)}` : '';
  const tool = 'rosrun suspension_health_monitor suspension_bag', launch = 'roslaunch suspension_health_monitor';
  const diagnose = [`${tool} diagnose`, ...bags.map(shellQuoted)].join(' ');
  const ofVehicle = (vehicle ? ` --vehicle ${shellQuoted(vehicle.file)}` : '') + given;
  const of = ofVehicle + (vehicle ? ` --strut ${vehicle.strut}` : '');
  const file = vehicle ? `${vehicle.strut}.yaml` : 'model.yaml', node = `/${vehicle ? vehicle.strut : 'monitor'}`;
  const request = effectsRequest(findings);
  return [
    ['Write the file', `${diagnose}${of} -o ${file}`],
    ['Judge the model on another drive', `${tool} compare another_drive.bag${of} --model ${file}`],
    ...(request ? [[
      'Live: add it to a running monitor and watch the error fall',
      `rosservice call ${node}/set_effects "${request}"\nrqt_plot ${node}/comparison/base_rmse ${node}/comparison/rmse`
    ]] :
                  []),
    vehicle ?
        [
          'Live from the start, with models of all struts',
          `${diagnose}${ofVehicle} -o models.yaml\n${launch} vehicle.launch vehicle:=${
              fromAnywhere(shellQuoted(vehicle.file))}${settings} model_file:=$PWD/models.yaml`
        ] :
        [
          'Live from the start',
          `${launch} monitor.launch sprung_imu:=${origin.topics[0]} unsprung_imu:=${origin.topics[1]}${
              settings} model_file:=$PWD/${file}`
        ]
  ];
}

function addingSection(findings) {
  return section(
      'adding', findings.after ? 'How to add it' : 'How to use the model',
      'The model as a file that monitor, simulator and command line load.', codeBlock(findings.model_file),
      commandsOf(findings).map(([title, text]) => [element('h3', {}, title), codeBlock(text)]));
}
